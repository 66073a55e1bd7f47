// Whether rings enclose a position, and where they lie.
//
//   if (in_ring(outline, {318000, 176000}) && !in_ring(hole, {318000, 176000})) ...
//   if (in_rings(foot.rings, {318000, 176000})) ...
#pragma once

#include <algorithm>
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

/// Tells whether an odd number of the rings encloses the position.
inline bool in_rings(const std::vector<std::vector<Point2>>& rings, Point2 p) {
  return std::count_if(rings.begin(), rings.end(), [&](const auto& ring) { return in_ring(ring, p); }) % 2 != 0;
}

/// The box about all corners.
inline Box box_of_rings(const std::vector<std::vector<Point2>>& rings) {
  Box box;
  for (const std::vector<Point2>& ring : rings)
    for (const Point2& p : ring) box.extend(p);
  return box;
}

}  // namespace itin
