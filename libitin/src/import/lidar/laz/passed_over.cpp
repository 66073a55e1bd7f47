#include "import/lidar/laz/passed_over.hpp"

namespace itin {

namespace {

// Symbols of PassedTimes::multiple_: 0 to 500 is the multiple; then those from -1 down to -10; then special ones.
constexpr std::uint32_t kMostMultiple = 500, kLeastMultiple = kMostMultiple + 10, kUnchanged = kLeastMultiple + 1,
                        kWholeTime = kUnchanged + 1;
constexpr std::uint32_t kFewMultiples = 10;
constexpr unsigned kMostUnlike = 3;

// The contexts of differences.
enum TimeContext : unsigned { kStep, kOnce, kFew, kMany, kMost, kBack, kFarBack, kNone, kUpperHalf };

/// `step` times `factor`, as the format has it: modulo 2^32.
std::int32_t multiplied(std::int32_t step, std::int32_t factor) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(step) * static_cast<std::uint32_t>(factor));
}

}  // namespace

void PassedTimes::pass(RangeDecoder& decoder) {
  // A symbol that names another sequence is followed by one of that sequence. Each is one that other symbols could have
  // stood for, so that no encoder writes many in a row; a damaged file may, until its bytes end.
  while (!decoder.ran_out()) {
    const bool first = sequences_[current_].step == 0;
    const std::uint32_t symbol = decoder.symbol(first ? first_ : multiple_);
    const std::uint32_t whole = first ? 2 : kWholeTime;
    if (symbol > whole) {
      current_ = (current_ + symbol - whole) % 4;
      continue;
    }
    if (symbol == whole) return pass_whole(decoder);
    if (!first) return pass_multiple(decoder, symbol);
    if (symbol == 1) pass_first(decoder);
    return;
  }
}

void PassedTimes::pass_first(RangeDecoder& decoder) {
  sequences_[current_] = {difference_.difference(decoder, kStep), 0};
}

void PassedTimes::pass_whole(RangeDecoder& decoder) {
  difference_.difference(decoder, kUpperHalf);
  decoder.bits(16), decoder.bits(16);
  current_ = newest_ = (newest_ + 1) % 4;
  sequences_[current_] = {};
}

void PassedTimes::pass_multiple(RangeDecoder& decoder, std::uint32_t symbol) {
  Sequence& sequence = sequences_[current_];
  if (symbol == kUnchanged) return;
  if (symbol == 0) return pass_unlike(decoder, 0, kNone);
  if (symbol == kMostMultiple) return pass_unlike(decoder, multiplied(sequence.step, kMostMultiple), kMost);
  if (symbol == kLeastMultiple) return pass_unlike(decoder, multiplied(sequence.step, -10), kFarBack);
  if (symbol == 1) sequence.unlike = 0;
  const TimeContext context = symbol == 1              ? kOnce
                              : symbol < kFewMultiples ? kFew
                              : symbol < kMostMultiple ? kMany
                                                       : kBack;
  difference_.difference(decoder, context);
}

void PassedTimes::pass_unlike(RangeDecoder& decoder, std::int32_t predicted, unsigned context) {
  Sequence& sequence = sequences_[current_];
  const std::int32_t step = difference_.next(decoder, predicted, context);
  if (++sequence.unlike > kMostUnlike) sequence = {step, 0};
}

void PassedColours::pass(RangeDecoder& decoder) {
  const std::uint32_t changed = decoder.symbol(changed_);
  const auto pass_byte = [&](unsigned byte) {
    if ((changed >> byte & 1) != 0) decoder.symbol(bytes_[byte]);
  };
  pass_byte(0), pass_byte(1);
  // Unless the colour is a grey, green and blue follow: their lower bytes, then their upper ones.
  if ((changed & 64) == 0) return;
  pass_byte(2), pass_byte(4), pass_byte(3), pass_byte(5);
}

}  // namespace itin
