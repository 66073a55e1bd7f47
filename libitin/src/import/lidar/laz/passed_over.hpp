// Parts of points that nobody asks for, but that stand between others in one stream of bytes. What is read of them is
// what tells where they end.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "import/lidar/laz/integer_decoder.hpp"

namespace itin {

/// Passes over GPS times. Up to four sequences of times go on side by side, as when several lasers take turns. A time
/// is a multiple of the last step of its sequence from the one before, and a difference from that; which contexts
/// follow depends on the steps, not on the times.
class PassedTimes {
 public:
  void pass(RangeDecoder& decoder);

 private:
  struct Sequence {
    std::int32_t step = 0;
    unsigned unlike = 0;  ///< how many times in a row were no small multiple of the step
  };

  void pass_first(RangeDecoder& decoder);
  void pass_multiple(RangeDecoder& decoder, std::uint32_t symbol);
  void pass_unlike(RangeDecoder& decoder, std::int32_t predicted, unsigned context);
  void pass_whole(RangeDecoder& decoder);

  SymbolModel first_{6}, multiple_{516};
  IntegerDecoder difference_{32, 9};
  std::array<Sequence, 4> sequences_;
  unsigned current_ = 0, newest_ = 0;
};

/// Passes over red, green and blue.
class PassedColours {
 public:
  void pass(RangeDecoder& decoder);

 private:
  SymbolModel changed_{128};
  std::vector<SymbolModel> bytes_ = std::vector<SymbolModel>(6, SymbolModel(256));
};

/// Passes over extra bytes.
class PassedBytes {
 public:
  explicit PassedBytes(std::uint32_t count) : bytes_(count, SymbolModel(256)) {}
  void pass(RangeDecoder& decoder) {
    for (SymbolModel& byte : bytes_) decoder.symbol(byte);
  }

 private:
  std::vector<SymbolModel> bytes_;
};

}  // namespace itin
