#include "verify/leaf_cover.hpp"

namespace itin {

namespace {

/// Tells whether the line through pq leaves all of the box to its right.
bool keeps_right(Position p, Position q, const GridBox& box) {
  for (const Position corner : {Position{box.xmin, box.ymin}, Position{box.xmax, box.ymin},
                                Position{box.xmin, box.ymax}, Position{box.xmax, box.ymax}}) {
    if (orientation(p, q, corner) > 0) return false;
  }
  return true;
}

}  // namespace

// Two convex sets share no area exactly when the line along one of their edges separates them.
bool shares_area(const Corners& triangle, const GridBox& box) {
  const auto [a, b, c] = triangle;
  if (std::max({a.x, b.x, c.x}) <= box.xmin || std::min({a.x, b.x, c.x}) >= box.xmax) return false;
  if (std::max({a.y, b.y, c.y}) <= box.ymin || std::min({a.y, b.y, c.y}) >= box.ymax) return false;
  return !keeps_right(a, b, box) && !keeps_right(b, c, box) && !keeps_right(c, a, box);
}

}  // namespace itin
