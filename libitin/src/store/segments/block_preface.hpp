// Blocks with a preface, which says more about their items: the features or the clusters that segments are part of.
// FORMAT.md says which blocks have a preface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "store/codec/byte_stream.hpp"

namespace itin {

struct PrefacedBlock {
  std::span<const std::uint8_t> preface;
  std::span<const std::uint8_t> items;  ///< the block's bytes as they are without a preface
};

inline std::vector<std::uint8_t> joined(const PrefacedBlock& block) {
  std::vector<std::uint8_t> bytes;
  put_varint(bytes, block.preface.size());
  bytes.insert(bytes.end(), block.preface.begin(), block.preface.end());
  bytes.insert(bytes.end(), block.items.begin(), block.items.end());
  return bytes;
}

/// Splits a block into preface and items. Throws DecodeError.
inline PrefacedBlock split(std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  const std::uint64_t size = in.varint();
  if (size > in.rest().size()) throw DecodeError("a preface ends too late");
  return {in.rest().first(size), in.rest().subspan(size)};
}

}  // namespace itin
