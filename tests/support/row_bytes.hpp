// The bytes of a store's rows.
#pragma once

#include <cstdint>
#include <vector>

#include "store/file/store_rows.hpp"

namespace itin::test {

/// A row's bytes, without its seal.
inline std::vector<std::uint8_t> bytes_of(const StoreRows& rows, BlobKind kind, std::uint64_t key) {
  return decoded(rows, kind, key,
                 [](StoreRows::Bytes row) { return std::vector<std::uint8_t>(row.begin(), row.end()); });
}

}  // namespace itin::test
