// The triangles of a Tin by their corners, so that they can be compared whatever the order of triangles and vertices.
#pragma once

#include <algorithm>
#include <array>
#include <set>

#include <itin/tin.hpp>

namespace itin::test {

using TriangleCorners = std::array<GridPoint, 3>;

/// The corners in the order of the triangle, the least first.
inline TriangleCorners smallest_first(TriangleCorners c) {
  std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
  return c;
}

inline std::set<TriangleCorners> triangles_of(const Tin& tin) {
  std::set<TriangleCorners> result;
  for (const Triangle& t : tin.triangles)
    result.insert(smallest_first({tin.vertices[t[0]], tin.vertices[t[1]], tin.vertices[t[2]]}));
  return result;
}

}  // namespace itin::test
