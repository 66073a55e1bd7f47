// How far apart two boxes of the grid are.
#pragma once

#include <algorithm>

#include <itin/geometry.hpp>

namespace itin {

/// Returns the square of the distance between two boxes in grid units, 0 where they meet. Precondition: neither is
/// empty.
inline double squared_gap(const GridBox& p, const GridBox& q) {
  const double x = std::max({0.0, 0.0 + q.xmin - p.xmax, 0.0 + p.xmin - q.xmax});
  const double y = std::max({0.0, 0.0 + q.ymin - p.ymax, 0.0 + p.ymin - q.ymax});
  return x * x + y * y;
}

}  // namespace itin
