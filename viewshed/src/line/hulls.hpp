// Convex hulls of places in the plane.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <itin/convex_hull.hpp>
#include <itin/geometry.hpp>

namespace itin::viewshed {

/// Twice the area of the triangle; positive where it turns left.
inline double left_of(Point2 a, Point2 b, Point2 p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Returns the corners of the hull, counterclockwise.
inline std::vector<Point2> hull_of(std::vector<Point2> points) {
  return convex_hull(
      std::move(points), [](Point2 a, Point2 b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); },
      [](Point2 a, Point2 b, Point2 c) { return left_of(a, b, c) > 0; });
}

inline double area_of(const std::vector<Point2>& hull) {
  double doubled = 0;
  for (std::size_t i = 2; i < hull.size(); ++i) doubled += left_of(hull[0], hull[i - 1], hull[i]);
  return doubled / 2;
}

/// Tells whether a side of the hull, which is counterclockwise, has all these places beyond it. If two convex shapes
/// are apart, one of them has such a side; so a box meets the hull, or may, if the hull has none.
inline bool beyond_a_side(const std::vector<Point2>& hull, std::span<const Point2> places) {
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    if (std::all_of(places.begin(), places.end(), [&](Point2 p) { return left_of(a, b, p) < 0; })) return true;
  }
  return false;
}

/// The length of the hull's border.
inline double length_of(const std::vector<Point2>& hull) {
  double length = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    length += std::hypot(b.x - a.x, b.y - a.y);
  }
  return length;
}

inline void add_corners(const Box& box, std::vector<Point2>& points) {
  for (const double x : {box.xmin, box.xmax})
    for (const double y : {box.ymin, box.ymax}) points.push_back({x, y});
}

}  // namespace itin::viewshed
