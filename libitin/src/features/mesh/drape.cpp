#include <algorithm>
#include <cmath>
#include <set>

#include "features/mesh/feature_group.hpp"
#include "features/plan/planar.hpp"
#include "features/plan/polygon_sides.hpp"

namespace itin {

namespace {

using TerrainEdge = std::pair<std::uint32_t, std::uint32_t>;

/// How far rounding may move an edge, in grid steps: by up to one where a ring meets it, and once more where lines are
/// made planar. So even an edge that no ring meets may get a vertex.
constexpr std::int32_t kRounded = 2;

/// The edges of all triangles at the plan's rings. They shield the triangles further inside from every new vertex.
std::set<TerrainEdge> edges_at_rings(const GridPolygon& plan, const TerrainHeights& terrain) {
  std::set<TerrainEdge> edges;
  for_each_edge(plan, [&](Position p, Position q) {
    for (const std::uint32_t t : terrain.triangles_along(p, q, kRounded)) {
      const Triangle& v = terrain.triangle(t);
      for (int i = 0; i < 3; ++i) edges.insert(std::minmax(v[i], v[(i + 1) % 3]));
    }
  });
  return edges;
}

PlanarLines plan_lines(const GridPolygon& plan, const PolygonSides& sides, const TerrainHeights& terrain,
                       const Progress& progress) {
  constexpr std::uint32_t kEaves = 0, kCrease = 1;
  const auto at = [](Point2 p) {
    return GridPoint{static_cast<std::int32_t>(std::llround(p.x)), static_cast<std::int32_t>(std::llround(p.y)), 0};
  };
  std::vector<OwnedSegment> segments;
  for_each_edge(plan, [&](Position a, Position b) { segments.push_back({{a.x, a.y, 0}, {b.x, b.y, 0}, kEaves}); });
  for (const auto& [v, w] : edges_at_rings(plan, terrain)) {
    const GridPoint &p = terrain.vertex(v), &q = terrain.vertex(w);
    for (const auto& [from, to] : sides.inside_parts({1.0 * p.x, 1.0 * p.y}, {1.0 * q.x, 1.0 * q.y}))
      segments.push_back({at(from), at(to), kCrease});
  }
  return make_planar(std::move(segments), &progress);
}

}  // namespace

bool drape(const GridPolygon& plan, double above, const TerrainHeights& terrain, std::vector<RoofLine>& lines,
           std::vector<GridPoint>& loose, const Progress& progress) {
  const PolygonSides sides(plan);
  PlanarLines planar = plan_lines(plan, sides, terrain, progress);
  std::set<Position> taken;
  for (GridPoint& p : planar.vertices) {
    const auto ground = terrain.height_at({p.x, p.y});
    if (!ground) return false;
    p.z = static_cast<std::int32_t>(std::llround(*ground / terrain.grid().resolution + above));
    taken.insert({p.x, p.y});
  }
  for (const PlanarEdge& e : planar.edges)
    lines.push_back({planar.vertices[e.from], planar.vertices[e.to], e.owner == 0});
  for (const std::uint32_t t : terrain.triangles_near(bounds_of({plan}))) {
    for (const std::uint32_t v : terrain.triangle(t)) {
      const GridPoint& p = terrain.vertex(v);
      if (sides.at({p.x, p.y}) != Side::inside || !taken.insert({p.x, p.y}).second) continue;
      loose.push_back({p.x, p.y, static_cast<std::int32_t>(std::llround(p.z + above))});
    }
  }
  return true;
}

}  // namespace itin
