// The Rice parameter that writes given values in the fewest bits.
#pragma once

#include <cstdint>
#include <vector>

#include "store/codec/bit_stream.hpp"

namespace itin {

/// Returns the bits of the values' codes, as though no code escaped.
inline std::uint64_t rice_bits(const std::vector<std::uint64_t>& values, int parameter) {
  std::uint64_t bits = 0;
  for (const std::uint64_t v : values) bits += (v >> parameter) + 1 + static_cast<std::uint64_t>(parameter);
  return bits;
}

inline int best_rice_parameter(const std::vector<std::uint64_t>& values) {
  int best = 0;
  for (int k = 1; k <= kMaxRiceParameter; ++k) {
    if (rice_bits(values, k) < rice_bits(values, best)) best = k;
  }
  return best;
}

}  // namespace itin
