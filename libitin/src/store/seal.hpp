// The checksum in front of every blob: the low 32 bits of XXH3-64 of the bytes after it, little-endian, seeded with
// the blob's key, so that a blob under another's key is found as well.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace itin {

enum class BlobKind { Block, Directory };

/// `bytes` with its seal in front.
std::vector<std::uint8_t> seal(BlobKind kind, std::uint64_t key, std::span<const std::uint8_t> bytes);
/// The bytes behind the seal; throws DecodeError where the seal does not fit.
std::span<const std::uint8_t> unseal(BlobKind kind, std::uint64_t key, std::span<const std::uint8_t> sealed);

/// XXH3-64 of text, as SQLite's signed integer.
std::int64_t text_checksum(std::string_view text);

}  // namespace itin
