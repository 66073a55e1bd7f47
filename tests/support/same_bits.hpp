// Whether two numbers are the same to the last bit, the sign of zero included.
#pragma once

#include <bit>
#include <cstdint>

namespace itin::test {

inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace itin::test
