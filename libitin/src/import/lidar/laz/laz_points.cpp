#include "import/lidar/laz/laz_points.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include <itin/parallel.hpp>

namespace itin {

namespace {

constexpr std::uint64_t kPointsAtOnce = std::uint64_t{1} << 19;
constexpr std::uint64_t kBytesAtOnce = std::uint64_t{32} << 20;

/// A chunk that is in memory, as far as it is decoded.
struct OpenChunk {
  LazChunk place;
  std::vector<std::uint8_t> bytes;
  std::unique_ptr<ChunkDecoder> decoder;
  std::vector<LazPoint> points;
};

class LazReader {
 public:
  LazReader(const std::string& path, const LazLayout& layout, const LazExtent& extent)
      : bytes_(path), layout_(layout), chunks_(chunk_table(bytes_, layout, extent)) {}

  void read(const LazSink& sink) {
    for (std::size_t next = 0; next < chunks_.size();) {
      std::vector<OpenChunk> group = open_group(next);
      next += group.size();
      // A chunk of more points is a group of its own, and is decoded piece by piece.
      for (std::uint64_t done = 0; done < group.front().place.points || done == 0; done += kPointsAtOnce) {
        parallel_for(group.size(), [&](std::size_t i) { decode(group[i], done); });
        for (const OpenChunk& chunk : group) {
          require_whole(chunk);
          if (!chunk.points.empty()) sink(chunk.points);
        }
      }
    }
  }

 private:
  std::vector<OpenChunk> open_group(std::size_t first) {
    std::vector<OpenChunk> group;
    std::uint64_t points = 0, bytes = 0;
    for (std::size_t i = first; i < chunks_.size(); ++i) {
      points += chunks_[i].points, bytes += chunks_[i].bytes;
      if (i > first && (points > kPointsAtOnce || bytes > kBytesAtOnce)) break;
      group.push_back(open(chunks_[i]));
    }
    return group;
  }

  OpenChunk open(const LazChunk& place) {
    OpenChunk chunk{place, std::vector<std::uint8_t>(place.bytes), nullptr, {}};
    bytes_.read(place.offset, {reinterpret_cast<char*>(chunk.bytes.data()), chunk.bytes.size()}, "the point data");
    if (place.points > 0 && layout_.layered && counted_points(layout_, chunk.bytes) != place.points)
      bytes_.fail(place.offset, fmt::format("a chunk of {} points has {} in the chunk table; the file is damaged",
                                            counted_points(layout_, chunk.bytes), place.points));
    return chunk;
  }

  /// Decodes the points of a chunk from `done` on, as many as are decoded at once. Decoders are made here, by threads.
  void decode(OpenChunk& chunk, std::uint64_t done) const {
    const std::uint64_t left = chunk.place.points - std::min(done, chunk.place.points);
    chunk.points.resize(std::min(left, kPointsAtOnce));
    if (chunk.points.empty()) return;
    if (!chunk.decoder) chunk.decoder = chunk_decoder(layout_, chunk.bytes);
    chunk.decoder->decode(chunk.points);
  }

  void require_whole(const OpenChunk& chunk) const {
    // The first point is not compressed.
    if (chunk.place.points > 1 && chunk.decoder->ran_out())
      bytes_.fail(chunk.place.offset,
                  fmt::format("a chunk of {} points ends early; the file is truncated or damaged", chunk.place.points));
  }

  FileBytes bytes_;
  const LazLayout& layout_;
  std::vector<LazChunk> chunks_;
};

}  // namespace

void read_laz(const std::string& path, const LazLayout& layout, const LazExtent& extent, const LazSink& sink) {
  LazReader(path, layout, extent).read(sink);
}

}  // namespace itin
