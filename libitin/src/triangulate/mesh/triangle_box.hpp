// Whether a triangle meets a box, exactly.
#pragma once

#include <array>

#include <itin/box_of.hpp>
#include <itin/geometry.hpp>

#include "geometry/predicates.hpp"

namespace itin {

/// Tells whether some corner of the box is left of pq or in line with it.
inline bool reaches_left_of(const GridBox& box, Position p, Position q) {
  // This is the corner farthest to the left of pq.
  const Position c{q.y > p.y ? box.xmin : box.xmax, q.x > p.x ? box.ymax : box.ymin};
  return orientation(p, q, c) >= 0;
}

/// Tells whether a triangle with these corners, counterclockwise, meets the box, by the separating axis theorem.
/// Touching counts.
inline bool triangle_meets(const std::array<Position, 3>& corners, const GridBox& box) {
  const GridBox about = box_of(corners);
  if (!about.meets(box)) return false;
  const auto& [a, b, c] = corners;
  return box.contains(about) ||
         (reaches_left_of(box, a, b) && reaches_left_of(box, b, c) && reaches_left_of(box, c, a));
}

}  // namespace itin
