#include "import/lidar/laz/chunk_table.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "import/lidar/laz/chunk_decoder.hpp"
#include "import/lidar/laz/integer_decoder.hpp"

namespace itin {

namespace {

constexpr std::uint64_t kPlaceBytes = 8, kHeadBytes = 8;
/// An entry is two numbers, which take less than 8 bytes each.
constexpr std::uint64_t kMostEntryBytes = 16;
constexpr std::uint64_t kMostChunkBytes = std::uint64_t{1} << 30;

/// The place of the table. A writer that could not go back to the beginning has it at the end of the file.
std::uint64_t table_place(FileBytes& bytes, const LazExtent& extent) {
  std::array<char, kPlaceBytes> place{};
  bytes.read(extent.offset, place, "the place of the chunk table");
  if (little_endian<std::int64_t>(place.data()) == -1 && bytes.size() >= kPlaceBytes)
    bytes.read(bytes.size() - kPlaceBytes, place, "the place of the chunk table");
  const auto at = little_endian<std::uint64_t>(place.data());
  if (at < extent.offset + kPlaceBytes || at > bytes.size() - kHeadBytes)
    bytes.fail(extent.offset, fmt::format("the chunk table is said to be at {}, outside the file's {} bytes; it is "
                                          "truncated or damaged",
                                          at, bytes.size()));
  return at;
}

std::vector<std::uint8_t> table_bytes(FileBytes& bytes, std::uint64_t place, std::uint64_t chunks) {
  std::vector<std::uint8_t> table(std::min(bytes.size() - place - kHeadBytes, (chunks + 1) * kMostEntryBytes));
  bytes.read(place + kHeadBytes, {reinterpret_cast<char*>(table.data()), table.size()}, "the chunk table");
  return table;
}

/// Gives all chunks the points of the layout, and the last one what is left.
void share_out(std::vector<LazChunk>& chunks, const LazLayout& layout, std::uint64_t points) {
  for (LazChunk& chunk : chunks) {
    chunk.points = std::min<std::uint64_t>(points, layout.chunk_points);
    points -= chunk.points;
  }
}

std::vector<LazChunk> decoded_table(std::span<const std::uint8_t> table, std::uint64_t count, bool with_points) {
  RangeDecoder decoder(table);
  IntegerDecoder numbers(32, 2);
  std::int32_t points = 0, bytes = 0;
  std::vector<LazChunk> chunks(count);
  for (LazChunk& chunk : chunks) {
    if (with_points) points = numbers.next(decoder, points, 0);
    bytes = numbers.next(decoder, bytes, 1);
    chunk.points = static_cast<std::uint32_t>(points), chunk.bytes = static_cast<std::uint32_t>(bytes);
  }
  return chunks;
}

/// Throws where chunks are not what the header promises, or not within the point data, which end at `end`.
void place_chunks(FileBytes& bytes, const LazLayout& layout, const LazExtent& extent, std::uint64_t end,
                  std::vector<LazChunk>& chunks) {
  std::uint64_t offset = extent.offset + kPlaceBytes, points = 0;
  for (LazChunk& chunk : chunks) {
    chunk.offset = offset;
    if (chunk.bytes > end - offset || chunk.bytes > kMostChunkBytes ||
        (chunk.points > 0 && chunk.bytes < least_chunk_bytes(layout)))
      bytes.fail(offset, fmt::format("a chunk of {} points is said to have {} bytes; the chunk table is damaged",
                                     chunk.points, chunk.bytes));
    offset += chunk.bytes, points += chunk.points;
  }
  if (points != extent.points)
    bytes.fail(extent.offset,
               fmt::format("the header promises {} points, but the chunks hold {}; the file is truncated "
                           "or damaged",
                           extent.points, points));
}

}  // namespace

std::vector<LazChunk> chunk_table(FileBytes& bytes, const LazLayout& layout, const LazExtent& extent) {
  const std::uint64_t place = table_place(bytes, extent);
  std::array<char, kHeadBytes> head{};
  bytes.read(place, head, "the chunk table");
  const std::uint64_t count = little_endian<std::uint32_t>(&head[4]);
  // Each chunk takes room, so that a damaged number is found before memory is taken for it.
  if (little_endian<std::uint32_t>(head.data()) != 0 || count > (place - extent.offset) / least_chunk_bytes(layout))
    bytes.fail(place, fmt::format("a chunk table of {} chunks is damaged", count));
  std::vector<LazChunk> chunks = decoded_table(table_bytes(bytes, place, count), count, layout.chunk_points == 0);
  if (layout.chunk_points > 0) share_out(chunks, layout, extent.points);
  place_chunks(bytes, layout, extent, place, chunks);
  return chunks;
}

}  // namespace itin
