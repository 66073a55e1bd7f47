// Bins of points, so that ground is found under each.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/raster.hpp>

namespace itin::viewshed {

/// Returns a grid of about as many bins as there are points, up to a quarter of a million.
inline RasterGrid bins_of_points(const std::vector<Point2>& points) {
  Box box;
  for (const Point2& p : points) box.extend(p);
  const double side = std::clamp(std::sqrt(static_cast<double>(points.size())), 1.0, 512.0);
  const double size = std::max({box.width(), box.height(), 1.0}) * 1.001 / std::floor(side);
  // Half a bin about them, so that no point lies on an edge.
  return {{box.xmin - size / 2, box.ymax + size / 2},
          size,
          size,
          static_cast<std::int64_t>(std::floor(side)) + 1,
          static_cast<std::int64_t>(std::floor(side)) + 1};
}

}  // namespace itin::viewshed
