// The content of blocks that hold features: whole numbers, numbers and texts, one after the other.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "store/codec/byte_stream.hpp"

namespace itin {

class ContentWriter {
 public:
  void whole(std::uint64_t v) { put_varint(bytes_, v); }
  void change(std::int64_t v) { put_varint(bytes_, zigzag(v)); }
  /// Writes eight bytes, little-endian.
  void word(std::uint64_t bits) {
    for (int shift = 0; shift < 64; shift += 8) bytes_.push_back(static_cast<std::uint8_t>(bits >> shift));
  }
  void number(double v) { word(std::bit_cast<std::uint64_t>(v)); }
  void text(const std::string& s) {
    whole(s.size());
    bytes_.insert(bytes_.end(), s.begin(), s.end());
  }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Reads the content of a block. Throws DecodeError.
class ContentReader {
 public:
  explicit ContentReader(std::span<const std::uint8_t> bytes) : in_(bytes) {}
  std::uint64_t whole(std::uint64_t most) { return in_.varint(0, most); }
  /// Reads the number of things that follow, each of at least one byte.
  std::size_t count() { return static_cast<std::size_t>(in_.varint(0, in_.rest().size())); }
  std::int64_t change() { return in_.signed_varint(); }
  std::uint64_t word() {
    std::uint64_t bits = 0;
    for (int shift = 0; shift < 64; shift += 8) bits |= static_cast<std::uint64_t>(in_.byte()) << shift;
    return bits;
  }
  double number() { return std::bit_cast<double>(word()); }
  std::string text() {
    std::string s;
    for (std::size_t n = count(); n > 0; --n) s.push_back(static_cast<char>(in_.byte()));
    return s;
  }
  bool at_end() const { return in_.rest().empty(); }

 private:
  ByteReader in_;
};

}  // namespace itin
