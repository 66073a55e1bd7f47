// The greatest common divisor of numbers that come one by one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <numeric>

namespace itin {

class CommonDivisor {
 public:
  void include(std::int64_t number) {
    const auto n = static_cast<std::uint64_t>(std::abs(number));
    // Most numbers are multiples of the divisor already.
    if (divisor_ == 0 || n % divisor_ != 0) divisor_ = std::gcd(divisor_, n);
  }
  /// Returns the divisor; 1 where all numbers are 0.
  std::uint64_t value() const { return std::max<std::uint64_t>(divisor_, 1); }

 private:
  std::uint64_t divisor_ = 0;
};

}  // namespace itin
