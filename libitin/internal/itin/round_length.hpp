// Lengths that scale bars show.
#pragma once

#include <cmath>

namespace itin {

/// 1, 2 or 5 times a power of ten, at most v, which is positive.
inline double round_length(double v) {
  const double decade = std::pow(10, std::floor(std::log10(v)));
  for (const double step : {5.0, 2.0})
    if (step * decade <= v) return step * decade;
  return decade;
}

}  // namespace itin
