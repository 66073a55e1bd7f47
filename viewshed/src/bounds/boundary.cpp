#include "bounds/boundary.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <itin/topology.hpp>

#include "line/hulls.hpp"

namespace itin::viewshed {

namespace {

double distance_to_segment(Point2 p, Point2 a, Point2 b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double along = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(a.x + along * dx - p.x, a.y + along * dy - p.y);
}

Point2 in_units(const Grid& units, Point2 p) {
  return {(p.x - units.origin.x) / units.resolution, (p.y - units.origin.y) / units.resolution};
}

/// A place of the hull lies to the right of a -> b; whether the hull reaches the segment.
bool meets_segment(const std::vector<Point2>& hull, Point2 a, Point2 b) {
  const bool crosses_straight = std::any_of(hull.begin(), hull.end(), [&](Point2 p) { return left_of(a, b, p) >= 0; });
  return crosses_straight && !beyond_a_side(hull, std::array{a, b});
}

}  // namespace

std::vector<BoundaryEdge> boundary_edges(const Tin& tin) {
  std::vector<BoundaryEdge> edges;
  const auto adjacent = adjacent_triangles(tin);
  for (std::size_t t = 0; t < adjacent.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (adjacent[t][i] == kNoNeighbour)
        edges.push_back({tin.triangles[t][i], tin.triangles[t][(i + 1) % 3], static_cast<std::uint32_t>(t)});
    }
  }
  return edges;
}

std::vector<RimEdge> rim_of(const Tin& tin, const std::vector<BoundaryEdge>& boundary) {
  std::vector<RimEdge> rim;
  rim.reserve(boundary.size());
  const auto place = [&](std::uint32_t vertex) { return GridPlace{tin.vertices[vertex].x, tin.vertices[vertex].y}; };
  for (const BoundaryEdge& edge : boundary) rim.push_back({place(edge.from), place(edge.to)});
  return rim;
}

bool surface_resumes(const Grid& units, const std::vector<RimEdge>& rim, Point2 position, double reach,
                     const std::vector<Point2>& lines) {
  const Point2 p = in_units(units, position);
  std::vector<Point2> hull;
  for (const Point2& corner : lines) hull.push_back(in_units(units, corner));
  return std::any_of(rim.begin(), rim.end(), [&](const RimEdge& edge) {
    const auto& [from, to] = edge;
    const Point2 a{static_cast<double>(from.x), static_cast<double>(from.y)};
    const Point2 b{static_cast<double>(to.x), static_cast<double>(to.y)};
    const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    // A millionth of a grid unit, so that a position on the boundary's own line does not count.
    const bool outside = side < -1e-6 * std::hypot(b.x - a.x, b.y - a.y);
    return outside && distance_to_segment(p, a, b) * units.resolution < reach && meets_segment(hull, a, b);
  });
}

}  // namespace itin::viewshed
