// The circumdisc of a triangle, which holds every vertex that could disturb it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <itin/geometry.hpp>

#include "geometry/predicates.hpp"

namespace itin {

/// Moves those sides of a box far away at which the bounds end.
inline GridBox with_all_beyond(GridBox box, const GridBox& bounds) {
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
  if (box.xmin <= bounds.xmin) box.xmin = -kFar;
  if (box.ymin <= bounds.ymin) box.ymin = -kFar;
  if (box.xmax >= bounds.xmax) box.xmax = kFar;
  if (box.ymax >= bounds.ymax) box.ymax = kFar;
  return box;
}

/// The circumdisc of the counterclockwise abc, rounded outwards; not finite where abc are as good as collinear.
struct Circumdisc {
  double x, y, reach;
};

inline Circumdisc circumdisc(Position a, Position b, Position c) {
  const double bx = static_cast<double>(b.x) - a.x, by = static_cast<double>(b.y) - a.y;
  const double cx = static_cast<double>(c.x) - a.x, cy = static_cast<double>(c.y) - a.y;
  const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy, d = 2 * (bx * cy - by * cx);
  const double ux = (cy * b2 - by * c2) / d, uy = (bx * c2 - cx * b2) / d, radius = std::sqrt(ux * ux + uy * uy);
  // The numerators lose at most 2^-50 of |b|^2 |c| + |c|^2 |b|; the area is exact to an ulp.
  const double slack = 1 + 1e-14 * (b2 * std::sqrt(c2) + c2 * std::sqrt(b2)) / std::abs(d) + 1e-14 * radius;
  return {a.x + ux, a.y + uy, radius + slack};
}

/// Tells whether the circumdisc of the counterclockwise abc surely lies in `box`.
inline bool circumdisc_in(Position a, Position b, Position c, const GridBox& box) {
  const auto [x, y, reach] = circumdisc(a, b, c);
  return x - reach >= box.xmin && x + reach <= box.xmax && y - reach >= box.ymin && y + reach <= box.ymax;
}

/// Tells whether the circumdisc may reach `box`.
inline bool circumdisc_reaches(Position a, Position b, Position c, const GridBox& box) {
  const auto [x, y, reach] = circumdisc(a, b, c);
  const double dx = std::max({box.xmin - x, x - box.xmax, 0.0}), dy = std::max({box.ymin - y, y - box.ymax, 0.0});
  // A disc that is not finite may reach any box.
  return !(std::hypot(dx, dy) > reach);
}

}  // namespace itin
