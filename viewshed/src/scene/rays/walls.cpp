#include "scene/rays/walls.hpp"

#include <algorithm>
#include <cmath>

namespace itin::viewshed {

Walls walls_under(const Tin& tin, const std::vector<BoundaryEdge>& boundary, const Tessellation& tessellation,
                  double drop) {
  Walls walls;
  const double metre = 1 / tin.grid.resolution;
  const auto bottom = static_cast<float>(-(2 * tessellation.half_height + metre));
  for (const BoundaryEdge& edge : boundary) {
    const auto first = static_cast<std::uint32_t>(walls.vertices.size() / 3);
    const GridPoint &a = tin.vertices[edge.from], &b = tin.vertices[edge.to];
    const double length = std::hypot(static_cast<double>(b.x) - a.x, static_cast<double>(b.y) - a.y);
    // The edge may have been cut, and then bulges above the straight wall.
    const auto bulge = static_cast<float>(std::max(drop, 0.0) * length * length / 4);
    for (const std::uint32_t end : {edge.from, edge.to}) {
      const float* const v = tessellation.vertices.data() + 3 * std::size_t{end};
      walls.vertices.insert(walls.vertices.end(), {v[0], v[1], bottom, v[0], v[1], v[2] + bulge});
    }
    walls.indices.insert(walls.indices.end(), {first, first + 2, first + 3, first, first + 3, first + 1});
  }
  return walls;
}

}  // namespace itin::viewshed
