// Whether a ring encloses a position.
//
//   if (in_ring(outline, {318000, 176000}) && !in_ring(hole, {318000, 176000})) ...
#pragma once

#include <vector>

#include <itin/geometry.hpp>

namespace itin {

/// Tells so by the even-odd rule, as exactly as floating point does. The last corner may repeat the first.
inline bool in_ring(const std::vector<Point2>& ring, Point2 p) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Point2 &a = ring[i], &b = ring[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
  }
  return inside;
}

}  // namespace itin
