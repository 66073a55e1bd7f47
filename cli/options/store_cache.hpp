// What is kept of a store where `--memory` bounds the work on it.
#pragma once

#include <algorithm>
#include <cstdint>

#include <itin/store.hpp>

namespace itin::cli {

/// At most a quarter of the memory.
inline StoreOptions cache_within(std::uint64_t memory_bytes) {
  return {std::min(StoreOptions().cache_bytes, memory_bytes / 4)};
}

}  // namespace itin::cli
