// Reads symbols and bits out of the bytes of one range encoder.
//
//   RangeDecoder decoder(bytes);
//   SymbolModel letters(26);
//   const std::uint32_t letter = decoder.symbol(letters);
//
// Whatever the bytes are, the answers are within their ranges. Bytes behind the end count as zeros: they make the
// decoder say that it ran_out().
#pragma once

#include <cstdint>
#include <span>

#include "import/lidar/laz/symbol_model.hpp"

namespace itin {

class RangeDecoder {
 public:
  RangeDecoder() = default;
  explicit RangeDecoder(std::span<const std::uint8_t> bytes) : next_(bytes.data()), end_(next_ + bytes.size()) {
    for (int i = 0; i < 4; ++i) shift_in_byte();
  }

  /// Whether more bytes were wanted than there are. A writer may leave out zeros at the end.
  bool ran_out() const { return beyond_ > kMostLeftOut; }

  std::uint32_t symbol(SymbolModel& model) {
    const std::uint32_t whole = length_;
    length_ >>= SymbolModel::kScaleBits;
    const std::uint32_t symbol = model.symbol_at(value_ / length_);
    const std::uint32_t from = model.below(symbol) * length_;
    const std::uint32_t to = symbol == model.last() ? whole : model.below(symbol + 1) * length_;
    narrow(from, to - from);
    model.count(symbol);
    return symbol;
  }

  bool bit(BitModel& model) {
    const std::uint32_t split = model.below_one() * (length_ >> BitModel::kScaleBits);
    const bool one = value_ >= split;
    one ? narrow(split, length_ - split) : narrow(0, split);
    model.count(one);
    return one;
  }

  /// Reads bits that are as often 0 as 1. Precondition: 1 to 32 bits.
  std::uint32_t bits(unsigned count) {
    constexpr unsigned kMostAtOnce = 19, kLower = 16;
    if (count > kMostAtOnce) {
      const std::uint32_t lower = bits(kLower);
      return bits(count - kLower) << kLower | lower;
    }
    length_ >>= count;
    const std::uint32_t read = value_ / length_;
    narrow(read * length_, length_);
    return read & ((std::uint32_t{1} << count) - 1);
  }

 private:
  static constexpr std::uint64_t kMostLeftOut = 4;
  static constexpr std::uint32_t kLeastLength = std::uint32_t{1} << 24;

  void shift_in_byte() {
    value_ <<= 8;
    if (next_ == end_)
      ++beyond_;
    else
      value_ |= *next_++;
  }
  void narrow(std::uint32_t from, std::uint32_t length) {
    value_ -= from;
    length_ = length;
    while (length_ < kLeastLength) {
      shift_in_byte();
      length_ <<= 8;
    }
  }

  const std::uint8_t* next_ = nullptr;
  const std::uint8_t* end_ = nullptr;
  std::uint32_t value_ = 0, length_ = 0xffffffff;  ///< where in the interval the code lies, and how long that is
  std::uint64_t beyond_ = 0;                       ///< bytes that were wanted behind the end
};

}  // namespace itin
