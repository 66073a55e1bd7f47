#include "store/codec/zstd_frame.hpp"

#include <stdexcept>

#include <zstd.h>

#include "store/codec/byte_stream.hpp"

namespace itin {

namespace {
constexpr int kCompressionLevel = 12;  // chunks are small and written once
}

std::vector<std::uint8_t> compress(std::span<const std::uint8_t> bytes) {
  std::vector<std::uint8_t> out(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kCompressionLevel);
  if (ZSTD_isError(size)) throw std::runtime_error(ZSTD_getErrorName(size));
  out.resize(size);
  return out;
}

std::vector<std::uint8_t> decompress(std::span<const std::uint8_t> frame, std::size_t most) {
  const auto size = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (size > most) throw DecodeError("has the wrong size");  // zstd's two error values are that large, too
  std::vector<std::uint8_t> out(size);
  const std::size_t written = ZSTD_decompress(out.data(), out.size(), frame.data(), frame.size());
  if (ZSTD_isError(written) || written != size) throw DecodeError("cannot be decompressed");
  return out;
}

}  // namespace itin
