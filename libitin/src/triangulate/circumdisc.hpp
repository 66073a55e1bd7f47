// Whether all that could disturb a triangle has been read: its circumdisc lies in a box of known positions.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include <itin/geometry.hpp>

#include "geometry/predicates.hpp"

namespace itin {

/// The sides of a box at which the bounds end moved far away.
inline GridBox with_all_beyond(GridBox box, const GridBox& bounds) {
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
  if (box.xmin <= bounds.xmin) box.xmin = -kFar;
  if (box.ymin <= bounds.ymin) box.ymin = -kFar;
  if (box.xmax >= bounds.xmax) box.xmax = kFar;
  if (box.ymax >= bounds.ymax) box.ymax = kFar;
  return box;
}

/// Whether the circumdisc of the counterclockwise abc surely lies in `box`.
inline bool circumdisc_in(Position a, Position b, Position c, const GridBox& box) {
  const double bx = static_cast<double>(b.x) - a.x, by = static_cast<double>(b.y) - a.y;
  const double cx = static_cast<double>(c.x) - a.x, cy = static_cast<double>(c.y) - a.y;
  const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy, d = 2 * (bx * cy - by * cx);
  const double ux = (cy * b2 - by * c2) / d, uy = (bx * c2 - cx * b2) / d, radius = std::sqrt(ux * ux + uy * uy);
  // The numerators lose at most 2^-50 of |b|^2 |c| + |c|^2 |b|; the area is exact to an ulp.
  const double slack = 1 + 1e-14 * (b2 * std::sqrt(c2) + c2 * std::sqrt(b2)) / std::abs(d) + 1e-14 * radius;
  const double x = a.x + ux, y = a.y + uy, reach = radius + slack;
  return x - reach >= box.xmin && x + reach <= box.xmax && y - reach >= box.ymin && y + reach <= box.ymax;
}

}  // namespace itin
