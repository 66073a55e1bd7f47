// Reads integers that were written as differences from a prediction: first how many bits the difference has, then which
// of the numbers with so many bits it is. Each context has statistics of its own for the first.
//
//   IntegerDecoder easting(32, 2);
//   x = easting.next(decoder, predicted, is_single ? 1 : 0);
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "import/lidar/laz/range_decoder.hpp"

namespace itin {

/// Adds modulo 2^32, so that damaged numbers do no harm.
constexpr std::int32_t wrapped_sum(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}

class IntegerDecoder {
 public:
  /// Integers of so many bits, at most 32.
  IntegerDecoder(unsigned bits, unsigned contexts) : widths_(contexts, SymbolModel(bits + 1)) {}

  /// Reads a difference.
  std::int32_t difference(RangeDecoder& decoder, unsigned context);
  /// Reads a number of 32 bits.
  std::int32_t next(RangeDecoder& decoder, std::int32_t predicted, unsigned context) {
    return wrapped_sum(predicted, difference(decoder, context));
  }
  /// How many bits the last difference had.
  unsigned width() const { return width_; }

 private:
  static constexpr unsigned kModelledBits = 8;  ///< bits below the highest eight are not modelled

  std::vector<SymbolModel> widths_;                  ///< by context
  std::array<std::optional<SymbolModel>, 32> high_;  ///< the highest bits of differences, by their width
  BitModel narrowest_;
  unsigned width_ = 0;
};

}  // namespace itin
