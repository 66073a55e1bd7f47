// Finds which positions lie in which triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/cell.hpp"
#include "geometry/predicates.hpp"

namespace itin {

/// Calls visit(t, position) for every triangle t of `count` (counterclockwise; `corners(t)` are its three positions)
/// and every position with one of the Morton codes that lies in it, borders included.
template <class Corners, class Visit>
void for_each_inside(std::size_t count, const Corners& corners, std::span<const std::uint64_t> codes,
                     const Visit& visit) {
  std::vector<Position> points;
  for (const std::uint64_t code : codes) points.push_back(position_of(code));
  std::sort(points.begin(), points.end());
  for (std::size_t t = 0; t < count; ++t) {
    const std::array<Position, 3> c = corners(t);
    const auto [xmin, xmax] = std::minmax({c[0].x, c[1].x, c[2].x});
    const auto [ymin, ymax] = std::minmax({c[0].y, c[1].y, c[2].y});
    auto p = std::lower_bound(points.begin(), points.end(), Position{xmin, ymin});
    while (p != points.end() && p->x <= xmax) {
      if (p->y < ymin || p->y > ymax) {  // on to those of this x, or of the next one, that are as high
        p = std::lower_bound(p, points.end(), Position{p->y < ymin ? p->x : p->x + 1, ymin});
        continue;
      }
      if (orientation(c[0], c[1], *p) >= 0 && orientation(c[1], c[2], *p) >= 0 && orientation(c[2], c[0], *p) >= 0)
        visit(t, *p);
      ++p;
    }
  }
}

}  // namespace itin
