// Lengths that scale bars show.
#pragma once

#include <cmath>

#include <itin/precondition.hpp>

namespace itin {

/// Returns the greatest of 1, 2 or 5 times a power of ten that is at most v. Precondition: v > 0.
inline double round_length(double v) {
  ITIN_PRECONDITION(v > 0);
  const double decade = std::pow(10, std::floor(std::log10(v)));
  for (const double step : {5.0, 2.0})
    if (step * decade <= v) return step * decade;
  return decade;
}

}  // namespace itin
