// The checksum in front of every blob: the low 32 bits of XXH3-64 of the bytes after it, little-endian. It is seeded
// with the blob's key, so that a blob under another's key is found as well.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace itin {

enum class BlobKind { Block, Directory };

/// The seed of hashes of a row, which tells it from a row under another key and from one of the other table.
constexpr std::uint64_t row_seed(BlobKind kind, std::uint64_t key) {
  return kind == BlobKind::Block ? key : ~key;
}

/// Returns `bytes` with their seal in front.
std::vector<std::uint8_t> seal(BlobKind kind, std::uint64_t key, std::span<const std::uint8_t> bytes);
/// Returns the bytes behind the seal. Throws DecodeError where the seal does not fit.
std::span<const std::uint8_t> unseal(BlobKind kind, std::uint64_t key, std::span<const std::uint8_t> sealed);

/// Returns the XXH3-64 of text, as SQLite's signed integer.
std::int64_t text_checksum(std::string_view text);

}  // namespace itin
