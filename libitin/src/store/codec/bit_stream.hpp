// Bits within a block: least significant first, in bytes of ascending address.
//
// A Rice code with parameter k writes v >> k in unary (that many zeros, then a one) and then the k low bits of v. From
// kRiceEscape zeros on, the value follows instead as a width of 6 bits and as many bits as that width, so that no value
// costs more than kRiceEscape + 66 bits.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include <itin/precondition.hpp>

namespace itin {

inline constexpr int kRiceEscape = 24;
/// With this limit, a code that does not escape fits into the 56 bits that a refill guarantees.
inline constexpr int kMaxRiceParameter = 31;

class BitWriter {
 public:
  explicit BitWriter(std::vector<std::uint8_t>& out) : out_(out) {}

  /// Writes the low `width` bits of v. Precondition: width <= 56.
  void bits(std::uint64_t v, int width) {
    ITIN_PRECONDITION(width <= 56);
    pending_ |= (v & ((std::uint64_t{1} << width) - 1)) << count_;
    count_ += width;
    for (; count_ >= 8; count_ -= 8, pending_ >>= 8) out_.push_back(static_cast<std::uint8_t>(pending_));
  }
  /// Writes a Rice code. Precondition: v < 2^63.
  void rice(std::uint64_t v, int k) {
    ITIN_PRECONDITION(v < std::uint64_t{1} << 63);
    if ((v >> k) < kRiceEscape) {
      const int zeros = static_cast<int>(v >> k);
      bits(std::uint64_t{1} << zeros, zeros + 1);
      bits(v, k);
      return;
    }
    const int width = std::bit_width(v);
    bits(0, kRiceEscape);
    bits(static_cast<std::uint64_t>(width), 6);
    bits(v, width / 2);
    bits(v >> (width / 2), width - width / 2);
  }
  /// Fills the last byte with zeros.
  void finish() {
    if (count_ > 0) out_.push_back(static_cast<std::uint8_t>(pending_));
    pending_ = 0, count_ = 0;
  }

 private:
  std::vector<std::uint8_t>& out_;
  std::uint64_t pending_ = 0;
  int count_ = 0;
};

/// Reads bits, but never outside its input: beyond the end it reads zeros, and finished_cleanly() is false.
class BitReader {
 public:
  /// The number of readable zero bytes that must follow the input.
  static constexpr std::size_t kPadding = 16;

  /// `padded` is the input followed by kPadding zeros.
  explicit BitReader(std::span<const std::uint8_t> padded)
      : begin_(padded.data()), end_(padded.data() + (padded.size() - kPadding)), next_(padded.data()) {}

  /// Reads `width` bits. Precondition: width <= 56.
  std::uint64_t bits(int width) {
    ITIN_PRECONDITION(width <= 56);
    refill();
    const std::uint64_t v = pending_ & ((std::uint64_t{1} << width) - 1);
    drop(width);
    return v;
  }
  std::uint64_t rice(int k) {
    refill();
    const int zeros = std::countr_zero(pending_ | (std::uint64_t{1} << kRiceEscape));
    if (zeros == kRiceEscape) [[unlikely]]
      return escaped();
    const std::uint64_t low = (pending_ >> (zeros + 1)) & ((std::uint64_t{1} << k) - 1);
    drop(zeros + 1 + k);
    return (static_cast<std::uint64_t>(zeros) << k) | low;
  }
  /// Tells whether exactly the input was read, up to zeros that fill its last byte.
  bool finished_cleanly() const {
    if (overrun_) return false;
    const auto read = (next_ - begin_) * 8 - count_;
    const auto left = (end_ - begin_) * 8 - read;
    if (left < 0 || left >= 8) return false;
    return left == 0 || (end_[-1] >> (8 - left)) == 0;
  }

 private:
  void refill() {
    std::uint64_t word;
    std::memcpy(&word, next_, sizeof word);
    if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap64(word);
    pending_ |= word << count_;
    next_ += (63 - count_) >> 3;
    count_ |= 56;
    if (next_ > end_ + 8) [[unlikely]] {
      next_ = end_ + 8;
      overrun_ = true;
    }
  }
  void drop(int width) {
    pending_ >>= width;
    count_ -= width;
  }
  std::uint64_t escaped() {
    drop(kRiceEscape);
    const int width = static_cast<int>(bits(6));
    const std::uint64_t low = bits(width / 2);
    return low | (bits(width - width / 2) << (width / 2));
  }

  const std::uint8_t* begin_;
  const std::uint8_t* end_;
  const std::uint8_t* next_;
  std::uint64_t pending_ = 0;
  int count_ = 0;
  bool overrun_ = false;
};

}  // namespace itin
