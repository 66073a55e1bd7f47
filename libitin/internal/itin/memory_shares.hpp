// How much of the memory for a call is for what is kept of a store.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include <itin/cross_section.hpp>
#include <itin/store.hpp>

namespace itin {

/// Returns store options that keep blocks in at most a quarter of the memory, where that is bounded.
inline StoreOptions cache_within(std::optional<std::uint64_t> memory_bytes) {
  StoreOptions options;
  if (memory_bytes) options.cache_bytes = std::min(options.cache_bytes, *memory_bytes / 4);
  return options;
}

/// Returns options that keep at most an eighth of the memory for the cross-sections of each surface.
inline SectionSurface::Options section_cache_within(std::optional<std::uint64_t> memory_bytes) {
  SectionSurface::Options options;
  if (memory_bytes) options.cache_bytes = std::min(options.cache_bytes, *memory_bytes / 8);
  return options;
}

}  // namespace itin
