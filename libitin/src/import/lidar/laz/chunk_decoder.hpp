// The points of one chunk of a LAZ file, one after the other.
//
//   const std::unique_ptr<ChunkDecoder> decoder = chunk_decoder(layout, chunk_bytes);
//   std::vector<LazPoint> points(chunk_points);
//   decoder->decode(points);
//   if (decoder->ran_out()) ...  // damaged
//
// Only what LazPoint has is decoded of layered points. Of others all has to be, for it is one stream of bytes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "import/lidar/laz/laz_layout.hpp"

namespace itin {

struct LazPoint {
  std::int32_t x = 0, y = 0, z = 0;  ///< before scale and offset
  std::uint8_t classification = 0;
  bool withheld = false;
};

class ChunkDecoder {
 public:
  virtual ~ChunkDecoder() = default;
  /// Decodes the next points.
  virtual void decode(std::span<LazPoint> points) = 0;
  /// Whether points wanted more bytes than the chunk has: it is damaged.
  virtual bool ran_out() const = 0;
};

/// The bytes must stay where they are. Precondition: at least least_chunk_bytes().
std::unique_ptr<ChunkDecoder> chunk_decoder(const LazLayout& layout, std::span<const std::uint8_t> bytes);

/// How many points a chunk of layered points says that it has. Precondition: as that of chunk_decoder().
std::uint32_t counted_points(const LazLayout& layout, std::span<const std::uint8_t> bytes);

/// The fewest bytes of a chunk: its first point, which is not compressed, and the sizes of layers.
std::uint64_t least_chunk_bytes(const LazLayout& layout);

}  // namespace itin
