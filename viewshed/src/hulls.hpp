// Convex hulls of places in the plane.
#pragma once

#include <utility>
#include <vector>

#include <itin/convex_hull.hpp>
#include <itin/geometry.hpp>

namespace itin::viewshed {

/// Twice the area of the triangle; positive where it turns left.
inline double left_of(Point2 a, Point2 b, Point2 p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Counterclockwise.
inline std::vector<Point2> hull_of(std::vector<Point2> points) {
  return convex_hull(
      std::move(points), [](Point2 a, Point2 b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); },
      [](Point2 a, Point2 b, Point2 c) { return left_of(a, b, c) > 0; });
}

inline void add_corners(const Box& box, std::vector<Point2>& points) {
  for (const double x : {box.xmin, box.xmax})
    for (const double y : {box.ymin, box.ymax}) points.push_back({x, y});
}

}  // namespace itin::viewshed
