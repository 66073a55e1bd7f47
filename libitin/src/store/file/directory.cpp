#include "store/file/directory.hpp"

#include <limits>

#include "store/codec/byte_stream.hpp"
#include "store/codec/store_format.hpp"
#include "store/codec/zstd_frame.hpp"

namespace itin {

namespace {

constexpr std::uint64_t kCurveEnd = std::uint64_t{1} << 60;
// The greatest size of a chunk: per leaf 1 byte for the side and 6 varints of at most 9 bytes, and then the count.
constexpr std::size_t kMaxChunkBytes = format::kChunkLeaves * 55 + 10;

std::int32_t read_int32(ByteReader& in) {
  const std::int64_t v = in.signed_varint();
  if (v < std::numeric_limits<std::int32_t>::min() || v > std::numeric_limits<std::int32_t>::max()) {
    throw DecodeError("an integer is out of range");
  }
  return static_cast<std::int32_t>(v);
}

void read_cells(ByteReader& in, int tree, const ChunkEntry& entry, DirectoryChunk& chunk) {
  for (Leaf& leaf : chunk) {
    leaf.level = tree;
    leaf.cell.log2_side = in.byte();
    if (leaf.cell.log2_side < format::kMinLeafLog2Side || leaf.cell.log2_side > kRootLog2Side) {
      throw DecodeError("a cell is too small or too large");
    }
  }
  std::uint64_t end = entry.code;
  for (Leaf& leaf : chunk) {
    leaf.cell.code = end + (in.varint(0, kCurveEnd >> 8) << 8);
    if (leaf.cell.code % (leaf.cell.end() - leaf.cell.code) != 0 || leaf.cell.end() > kCurveEnd) {
      throw DecodeError("a cell is misplaced");
    }
    leaf.key = format::key(tree, leaf.cell.code);
    end = leaf.cell.end();
  }
}

}  // namespace

ChunkEntry entry_of(const DirectoryChunk& chunk) {
  ChunkEntry entry{chunk.front().cell.code, chunk.back().cell.end(), chunk.size(), 0};
  for (const Leaf& leaf : chunk) entry.points += leaf.points;
  return entry;
}

std::vector<std::uint8_t> encode_chunk(const DirectoryChunk& chunk) {
  std::vector<std::uint8_t> out;
  for (const Leaf& leaf : chunk) out.push_back(static_cast<std::uint8_t>(leaf.cell.log2_side));
  std::uint64_t end = chunk.front().cell.code;
  for (const Leaf& leaf : chunk) {
    put_varint(out, (leaf.cell.code - end) >> 8);
    end = leaf.cell.end();
  }
  for (const Leaf& leaf : chunk) put_varint(out, leaf.points);
  std::int64_t previous = 0;
  for (const Leaf& leaf : chunk) {
    put_varint(out, zigzag(leaf.zmin - previous));
    previous = leaf.zmin;
  }
  for (const Leaf& leaf : chunk) put_varint(out, static_cast<std::uint64_t>(std::int64_t{leaf.zmax} - leaf.zmin));
  for (const Leaf& leaf : chunk) put_varint(out, zigzag(leaf.lo));
  for (const Leaf& leaf : chunk) put_varint(out, zigzag(leaf.hi));
  return compress(out);
}

DirectoryChunk decode_chunk(std::span<const std::uint8_t> bytes, int tree, const ChunkEntry& entry) {
  const std::vector<std::uint8_t> columns = decompress(bytes, kMaxChunkBytes);
  ByteReader in(columns);
  DirectoryChunk chunk(entry.leaves);
  read_cells(in, tree, entry, chunk);
  for (Leaf& leaf : chunk)
    leaf.points = static_cast<std::uint32_t>(in.varint(0, std::numeric_limits<std::uint32_t>::max()));
  std::int64_t previous = 0;
  for (Leaf& leaf : chunk) {
    const std::int64_t zmin = previous + in.signed_varint();
    if (zmin < std::numeric_limits<std::int32_t>::min() || zmin > std::numeric_limits<std::int32_t>::max()) {
      throw DecodeError("a height is out of range");
    }
    leaf.zmin = static_cast<std::int32_t>(zmin);
    previous = zmin;
  }
  for (Leaf& leaf : chunk) {
    const auto room = static_cast<std::uint64_t>(std::int64_t{std::numeric_limits<std::int32_t>::max()} - leaf.zmin);
    leaf.zmax = static_cast<std::int32_t>(leaf.zmin + static_cast<std::int64_t>(in.varint(0, room)));
  }
  for (Leaf& leaf : chunk) leaf.lo = read_int32(in);
  for (Leaf& leaf : chunk) leaf.hi = read_int32(in);
  const ChunkEntry found = entry_of(chunk);
  if (!in.rest().empty() || found.code != entry.code || found.end != entry.end || found.points != entry.points) {
    throw DecodeError("does not agree with the list of chunks");
  }
  return chunk;
}

std::vector<std::uint8_t> encode_chunk_list(const ChunkList& list) {
  std::vector<std::uint8_t> out;
  put_varint(out, list.size());
  for (const auto& [tree, chunks] : list) {
    put_varint(out, static_cast<std::uint64_t>(tree));
    put_varint(out, chunks.size());
    std::uint64_t end = 0;
    for (const ChunkEntry& chunk : chunks) {
      put_varint(out, (chunk.code - end) >> 8);
      put_varint(out, (chunk.end - chunk.code) >> 8);
      put_varint(out, chunk.leaves);
      put_varint(out, chunk.points);
      end = chunk.end;
    }
  }
  return out;
}

ChunkList decode_chunk_list(std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  ChunkList list;
  int previous_tree = -1;
  for (std::uint64_t trees = in.varint(0, format::kLastTree + 1); trees > 0; --trees) {
    const auto tree = static_cast<int>(in.varint(static_cast<std::uint64_t>(previous_tree + 1), format::kLastTree));
    previous_tree = tree;
    std::vector<ChunkEntry>& chunks = list[tree];
    std::uint64_t end = 0;
    for (std::uint64_t count = in.varint(1, in.rest().size()); count > 0; --count) {
      ChunkEntry chunk;
      chunk.code = end + (in.varint(0, (kCurveEnd - end) >> 8) << 8);
      chunk.end = chunk.code + (in.varint(0, (kCurveEnd - chunk.code) >> 8) << 8);
      chunk.leaves = in.varint(1, format::kChunkLeaves);
      chunk.points = in.varint();
      end = chunk.end;
      chunks.push_back(chunk);
    }
  }
  if (!in.rest().empty()) throw DecodeError("has too many bytes");
  return list;
}

}  // namespace itin
