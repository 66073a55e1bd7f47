#include "pyramid/coverage/grounded.hpp"

#include <algorithm>

#include <itin/box_of.hpp>
#include <itin/detail.hpp>
#include <itin/sort_unique.hpp>

#include "pyramid/coverage/gap_rule.hpp"
#include "pyramid/difference/points_in_triangles.hpp"
#include "triangulate/apex/apex.hpp"
#include "triangulate/mesh/circumdisc.hpp"
#include "triangulate/mesh/delaunay.hpp"
#include "triangulate/region/lattice_squares.hpp"
#include "triangulate/region/region_reader.hpp"

namespace itin {

namespace {

using Corners = std::array<Position, 3>;

/// The Delaunay triangulation of positions in Morton order; the triangles of lattice squares within `known` come first.
PlaneMesh triangulated(const std::vector<Position>& positions, const LatticeSquares& squares) {
  std::vector<Position> rest;
  for (const std::uint32_t v : squares.rest()) rest.push_back(positions[v]);
  Delaunay delaunay;
  delaunay.insert(rest, squares.rest());
  PlaneMesh mesh = delaunay.mesh();
  squares.fill(mesh);
  return mesh;
}

/// Whether a vertex that was not read disturbs the triangle.
bool disturbed(const Corners& c, ApexSearch& search) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (search.intruder(c[(i + 2) % 3], c[(i + 1) % 3], c[i])) return true;
  }
  return false;
}

/// The ground triangles that meet a box, and some about it. They are among the triangles of the points within the gap
/// about the box. Such a triangle is one of the whole triangulation unless a vertex beyond lies in its circle.
std::vector<Corners> ground_about(const GridBox& box, const SourceIndex& points,
                                  const std::vector<std::array<double, 4>>& gap_bases) {
  const GapRule gaps(gap_bases);
  const Selection everything(Detail::tolerance(0), {0.0}, Grid{});
  const GridBox near = intersection(expanded(box, gaps.reach(points.sources())), points.bounds());
  std::vector<Corners> ground;
  if (near.empty()) return ground;
  RegionReader read(points, everything);
  read.start(near, {}, near);
  std::vector<Position> positions;
  for (const SelectedVertex& v : read.vertices()) positions.push_back(v.position());
  const GridBox known = with_all_beyond(near, points.bounds());
  const LatticeSquares squares(positions, {}, known);
  const PlaneMesh mesh = triangulated(positions, squares);
  ApexSearch search(points, everything);
  search.pass_over(near);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (!gaps.ground(read.vertices()[a], read.vertices()[b], read.vertices()[c])) continue;
    const Corners corners{positions[a], positions[b], positions[c]};
    if (t < squares.triangle_count() || circumdisc_in(corners[0], corners[1], corners[2], known) ||
        !disturbed(corners, search))
      ground.push_back(corners);
  }
  return ground;
}

}  // namespace

std::vector<std::uint64_t> grounded(std::span<const std::uint64_t> codes, const SourceIndex& points,
                                    const std::vector<std::array<double, 4>>& gap_bases) {
  const std::vector<Corners> ground = ground_about(box_of(codes, position_of), points, gap_bases);
  std::vector<std::uint64_t> result;
  for_each_inside(
      ground.size(), [&](std::size_t t) { return ground[t]; }, codes,
      [&](std::size_t, Position p) { result.push_back(code_of(p)); });
  sort_unique(result);
  return result;
}

}  // namespace itin
