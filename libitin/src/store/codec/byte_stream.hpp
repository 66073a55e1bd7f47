// Bytes of directory chunks, edge blocks and block headers: little-endian base-128 integers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace itin {

/// Bytes that no encoder of itin wrote. The store adds file and place and throws CorruptStore.
class DecodeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Maps 0, -1, 1, -2, 2, ... to 0, 1, 2, 3, 4, ...
constexpr std::uint64_t zigzag(std::int64_t v) {
  return (static_cast<std::uint64_t>(v) << 1) ^ static_cast<std::uint64_t>(v >> 63);
}
constexpr std::int64_t unzigzag(std::uint64_t v) {
  return static_cast<std::int64_t>(v >> 1) ^ -static_cast<std::int64_t>(v & 1);
}

inline void put_varint(std::vector<std::uint8_t>& out, std::uint64_t v) {
  for (; v >= 0x80; v >>= 7) out.push_back(static_cast<std::uint8_t>(v | 0x80));
  out.push_back(static_cast<std::uint8_t>(v));
}

class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint8_t byte() {
    if (bytes_.empty()) throw DecodeError("ends too early");
    const std::uint8_t b = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return b;
  }
  /// Reads this many bytes.
  std::span<const std::uint8_t> bytes(std::size_t count) {
    if (bytes_.size() < count) throw DecodeError("ends too early");
    const std::span<const std::uint8_t> read = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return read;
  }
  std::uint64_t varint() {
    std::uint64_t v = 0;
    for (int shift = 0; shift < 63; shift += 7) {
      const std::uint8_t b = byte();
      v |= static_cast<std::uint64_t>(b & 0x7f) << shift;
      if (b < 0x80) return v;
    }
    throw DecodeError("an integer is longer than 63 bits");
  }
  /// Reads a varint in [low, high].
  std::uint64_t varint(std::uint64_t low, std::uint64_t high) {
    const std::uint64_t v = varint();
    if (v < low || v > high) throw DecodeError("an integer is out of range");
    return v;
  }
  std::int64_t signed_varint() { return unzigzag(varint()); }
  std::span<const std::uint8_t> rest() const { return bytes_; }

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace itin
