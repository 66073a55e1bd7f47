#include "scene/rays/walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace itin::viewshed {

namespace {

/// The edges of a boundary as walls have them: in single precision, from below everything to above the surface.
class WallEdges {
 public:
  WallEdges(const Tin& tin, const Tessellation& tessellation, double drop)
      : tin_(tin),
        vertices_(tessellation.vertices),
        drop_(std::max(drop, 0.0)),
        bottom_(static_cast<float>(-(2 * tessellation.half_height + 1 / tin.grid.resolution))) {}

  /// Adds the places below and above a vertex of the edge, `aside` of it.
  void add(const BoundaryEdge& edge, std::uint32_t vertex, Point2 aside, Barrier& barrier) const {
    // The edge may have been cut, and then bulges above the straight wall.
    const Point2 along = direction(edge);
    const auto bulge = static_cast<float>(drop_ * (along.x * along.x + along.y * along.y) / 4);
    const float* const v = vertices_.data() + 3 * std::size_t{vertex};
    const auto x = static_cast<float>(v[0] + aside.x), y = static_cast<float>(v[1] + aside.y);
    barrier.vertices.insert(barrier.vertices.end(), {x, y, bottom_, x, y, v[2] + bulge});
  }

  /// The direction of an edge, from one end to the other, grid units.
  Point2 direction(const BoundaryEdge& edge) const {
    const GridPoint &a = tin_.vertices[edge.from], &b = tin_.vertices[edge.to];
    return {static_cast<double>(b.x) - a.x, static_cast<double>(b.y) - a.y};
  }

 private:
  const Tin& tin_;
  const std::vector<float>& vertices_;
  double drop_;
  float bottom_;
};

/// Two triangles through four vertices, counted from `first`.
void add_face(std::uint32_t first, const std::array<std::uint32_t, 4>& corners, Barrier& barrier) {
  const auto& [a, b, c, d] = corners;
  barrier.indices.insert(barrier.indices.end(), {first + a, first + b, first + c, first + a, first + c, first + d});
}

}  // namespace

Barrier walls_under(const Tin& tin, const std::vector<BoundaryEdge>& boundary, const Tessellation& tessellation,
                    double drop) {
  const WallEdges edges(tin, tessellation, drop);
  Barrier walls;
  for (const BoundaryEdge& edge : boundary) {
    const auto first = static_cast<std::uint32_t>(walls.vertices.size() / 3);
    for (const std::uint32_t end : {edge.from, edge.to}) edges.add(edge, end, {0, 0}, walls);
    add_face(first, {0, 2, 3, 1}, walls);
  }
  return walls;
}

Barrier boxes_about(const Tin& tin, const std::vector<BoundaryEdge>& boundary, const Tessellation& tessellation,
                    double drop, double margin) {
  const WallEdges edges(tin, tessellation, drop);
  Barrier boxes;
  for (const BoundaryEdge& edge : boundary) {
    const auto first = static_cast<std::uint32_t>(boxes.vertices.size() / 3);
    const Point2 along = edges.direction(edge);
    const double scale = margin / std::hypot(along.x, along.y);
    const Point2 ahead{scale * along.x, scale * along.y}, right{ahead.y, -ahead.x};
    for (const double to_right : {1.0, -1.0}) {
      const Point2 side{to_right * right.x, to_right * right.y};
      edges.add(edge, edge.from, {side.x - ahead.x, side.y - ahead.y}, boxes);
      edges.add(edge, edge.to, {side.x + ahead.x, side.y + ahead.y}, boxes);
    }
    // The faces come in the order of BoxFace.
    add_face(first, {0, 2, 3, 1}, boxes);
    add_face(first, {4, 6, 7, 5}, boxes);
    add_face(first, {2, 6, 7, 3}, boxes);
    add_face(first, {0, 4, 5, 1}, boxes);
    add_face(first, {1, 3, 7, 5}, boxes);
  }
  return boxes;
}

}  // namespace itin::viewshed
