// How far a position is from a straight line between two others.
#pragma once

#include <algorithm>
#include <cmath>

#include <itin/geometry.hpp>

namespace itin {

/// Returns the way to p from the nearest place between a and b, in their unit.
inline Point2 way_from_segment(Point2 p, Point2 a, Point2 b) {
  const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
  const double share = squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0;
  return {p.x - a.x - share * dx, p.y - a.y - share * dy};
}

/// Returns the distance from p to the nearest place between a and b, in their unit.
inline double distance_to_segment(Point2 p, Point2 a, Point2 b) {
  const Point2 way = way_from_segment(p, a, b);
  return std::hypot(way.x, way.y);
}

}  // namespace itin
