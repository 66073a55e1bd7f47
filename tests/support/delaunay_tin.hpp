// Small Tins for tests, triangulated by CGAL without a store.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <itin/tin.hpp>

namespace itin::test {

/// Puts vertices in the order of their ids and triangles in canonical order, and drops vertices that none uses.
inline Tin canonical_tin(const Grid& grid, const std::vector<GridPoint>& points,
                         const std::vector<std::uint16_t>& sources, std::vector<Triangle> triangles) {
  Tin whole;
  whole.grid = grid;
  whole.vertices = points;
  whole.sources = sources;
  std::set<std::uint32_t> used;
  for (const Triangle& t : triangles) used.insert(t.begin(), t.end());
  std::vector<std::uint32_t> order(used.begin(), used.end());
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return whole.id(a) < whole.id(b); });
  Tin tin;
  tin.grid = grid;
  std::map<std::uint32_t, std::uint32_t> renumbered;
  for (const std::uint32_t v : order) {
    renumbered[v] = static_cast<std::uint32_t>(tin.vertices.size());
    tin.vertices.push_back(points[v]);
    tin.sources.push_back(sources[v]);
  }
  for (Triangle t : triangles) {
    for (auto& v : t) v = renumbered[v];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    tin.triangles.push_back(t);
  }
  std::sort(tin.triangles.begin(), tin.triangles.end());
  return tin;
}

/// The Delaunay triangulation of points at distinct positions; `keep` may leave out triangles to make holes.
inline Tin delaunay_tin(const Grid& grid, const std::vector<GridPoint>& points,
                        const std::vector<std::uint16_t>& sources,
                        const std::function<bool(const GridPoint&, const GridPoint&, const GridPoint&)>& keep) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  CGAL::Delaunay_triangulation_2<Kernel> triangulation;
  std::map<std::pair<std::int32_t, std::int32_t>, std::uint32_t> index;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    index[{points[i].x, points[i].y}] = i;
    triangulation.insert({static_cast<double>(points[i].x), static_cast<double>(points[i].y)});
  }
  std::vector<Triangle> triangles;
  for (const auto& face : triangulation.finite_face_handles()) {
    Triangle t;
    for (int i = 0; i < 3; ++i) {
      const auto p = face->vertex(i)->point();
      t[static_cast<std::size_t>(i)] = index.at({static_cast<std::int32_t>(p.x()), static_cast<std::int32_t>(p.y())});
    }
    if (keep(points[t[0]], points[t[1]], points[t[2]])) triangles.push_back(t);
  }
  return canonical_tin(grid, points, sources, std::move(triangles));
}

/// About `count` vertices with heights up to 1000 grid units and three sources; a share of the triangles is left out.
inline Tin random_tin(std::mt19937& random, int count, double holes, const Grid& grid = {{0, 0}, 0.01},
                      std::int32_t reach = 10000) {
  std::uniform_int_distribution<std::int32_t> position(-reach, reach), height(-100, 1000);
  std::set<std::pair<std::int32_t, std::int32_t>> taken;
  std::vector<GridPoint> points;
  std::vector<std::uint16_t> sources;
  for (int i = 0; i < count; ++i) {
    const GridPoint p{position(random), position(random), height(random)};
    if (!taken.insert({p.x, p.y}).second) continue;
    points.push_back(p);
    sources.push_back(static_cast<std::uint16_t>(i % 3));
  }
  std::bernoulli_distribution dropped(holes);
  return delaunay_tin(grid, points, sources, [&](const auto&, const auto&, const auto&) { return !dropped(random); });
}

}  // namespace itin::test
