// The directory of a quadtree's leaves, in chunks of up to format::kChunkLeaves, and the list of all chunks. See
// libitin/FORMAT.md, "Directory".
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "store/codec/point_index.hpp"

namespace itin {

/// The leaves of one tree in ascending order of cell.code.
using DirectoryChunk = std::vector<Leaf>;

/// The part of a chunk that is always in memory.
struct ChunkEntry {
  std::uint64_t code = 0;  ///< where the chunk's first leaf begins
  std::uint64_t end = 0;   ///< where the chunk's last leaf ends
  std::uint64_t leaves = 0;
  std::uint64_t points = 0;  ///< for an edge tree, segments
};

/// The chunks of each tree in ascending order of code.
using ChunkList = std::map<int, std::vector<ChunkEntry>>;

ChunkEntry entry_of(const DirectoryChunk& chunk);

std::vector<std::uint8_t> encode_chunk(const DirectoryChunk& chunk);
/// Decodes a chunk. Throws DecodeError unless the bytes are a chunk of `tree` that fits `entry`.
DirectoryChunk decode_chunk(std::span<const std::uint8_t> bytes, int tree, const ChunkEntry& entry);

std::vector<std::uint8_t> encode_chunk_list(const ChunkList& list);
/// Decodes the list. Throws DecodeError unless the bytes are a list of disjoint chunks in ascending order.
ChunkList decode_chunk_list(std::span<const std::uint8_t> bytes);

}  // namespace itin
