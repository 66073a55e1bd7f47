#include "store/codec/seal.hpp"

#include <bit>

#include <xxhash.h>

#include "store/codec/byte_stream.hpp"

namespace itin {

namespace {

constexpr std::size_t kSealBytes = 4;

std::uint32_t checksum(BlobKind kind, std::uint64_t key, std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint32_t>(XXH3_64bits_withSeed(bytes.data(), bytes.size(), row_seed(kind, key)));
}

}  // namespace

std::vector<std::uint8_t> seal(BlobKind kind, std::uint64_t key, std::span<const std::uint8_t> bytes) {
  const std::uint32_t sum = checksum(kind, key, bytes);
  std::vector<std::uint8_t> sealed;
  sealed.reserve(kSealBytes + bytes.size());
  for (int shift = 0; shift < 32; shift += 8) sealed.push_back(static_cast<std::uint8_t>(sum >> shift));
  sealed.insert(sealed.end(), bytes.begin(), bytes.end());
  return sealed;
}

std::span<const std::uint8_t> unseal(BlobKind kind, std::uint64_t key, std::span<const std::uint8_t> sealed) {
  if (sealed.size() < kSealBytes) throw DecodeError("ends too early");
  std::uint32_t stored = 0;
  for (std::size_t i = 0; i < kSealBytes; ++i) stored |= std::uint32_t{sealed[i]} << (8 * i);
  const auto bytes = sealed.subspan(kSealBytes);
  if (stored != checksum(kind, key, bytes)) throw DecodeError("checksum does not match, the data is damaged");
  return bytes;
}

std::int64_t text_checksum(std::string_view text) {
  return std::bit_cast<std::int64_t>(static_cast<std::uint64_t>(XXH3_64bits(text.data(), text.size())));
}

}  // namespace itin
