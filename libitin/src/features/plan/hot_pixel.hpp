// The pixels of snap rounding: the unit squares about grid positions, closed below and to the left, open above and to
// the right. Every point of the plane lies in exactly one.
#pragma once

#include <cstdint>

#include "geometry/predicates.hpp"

namespace itin {

/// The pixel in which ab and cd cross; precondition: they cross properly.
Position crossing_pixel(Position a, Position b, Position c, Position d);

/// Whether the closed segment ab meets the pixel about p, exactly.
bool meets_pixel(Position a, Position b, Position p);

/// Whether p lies on the closed segment ab.
template <GridPosition P>
bool on_segment(const P& a, const P& b, const P& p) {
  if (orientation(a, b, p) != 0) return false;
  return (std::int64_t{p.x} - a.x) * (std::int64_t{p.x} - b.x) <= 0 &&
         (std::int64_t{p.y} - a.y) * (std::int64_t{p.y} - b.y) <= 0;
}

/// round(numerator / denominator), halves upwards.
constexpr std::int64_t rounded_quotient(Int128 numerator, Int128 denominator) {
  if (denominator < 0) numerator = -numerator, denominator = -denominator;
  const Int128 twice = 2 * numerator + denominator, whole = 2 * denominator;
  const Int128 quotient = twice / whole;
  return static_cast<std::int64_t>(quotient - (twice % whole < 0));
}

}  // namespace itin
