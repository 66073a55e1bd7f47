// Blocks whose items are told more about before them: what features segments are of, or what clusters. FORMAT.md says
// which blocks have a preface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "store/byte_stream.hpp"

namespace itin {

struct PrefacedBlock {
  std::span<const std::uint8_t> preface;
  std::span<const std::uint8_t> items;  ///< the block as it is elsewhere
};

inline std::vector<std::uint8_t> joined(const PrefacedBlock& block) {
  std::vector<std::uint8_t> bytes;
  put_varint(bytes, block.preface.size());
  bytes.insert(bytes.end(), block.preface.begin(), block.preface.end());
  bytes.insert(bytes.end(), block.items.begin(), block.items.end());
  return bytes;
}

/// Throws DecodeError.
inline PrefacedBlock split(std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  const std::uint64_t size = in.varint();
  if (size > in.rest().size()) throw DecodeError("a preface ends too late");
  return {in.rest().first(size), in.rest().subspan(size)};
}

}  // namespace itin
