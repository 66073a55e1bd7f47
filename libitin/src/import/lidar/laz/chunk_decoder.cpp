#include "import/lidar/laz/chunk_decoder.hpp"

#include <itin/precondition.hpp>

#include "base/file_bytes.hpp"
#include "import/lidar/laz/layered_points.hpp"
#include "import/lidar/laz/plain_points.hpp"

namespace itin {

std::unique_ptr<ChunkDecoder> chunk_decoder(const LazLayout& layout, std::span<const std::uint8_t> bytes) {
  ITIN_PRECONDITION(bytes.size() >= least_chunk_bytes(layout));
  if (layout.layered) return std::make_unique<LayeredPoints>(layout, bytes);
  return std::make_unique<PlainPoints>(layout, bytes);
}

std::uint32_t counted_points(const LazLayout& layout, std::span<const std::uint8_t> bytes) {
  ITIN_PRECONDITION(layout.layered && bytes.size() >= least_chunk_bytes(layout));
  return little_endian<std::uint32_t>(&bytes[layout.record_length]);
}

std::uint64_t least_chunk_bytes(const LazLayout& layout) {
  constexpr std::uint64_t kCountBytes = 4, kSizeBytes = 4;
  return layout.record_length + (layout.layered ? kCountBytes + layout.layers * kSizeBytes : 0);
}

}  // namespace itin
