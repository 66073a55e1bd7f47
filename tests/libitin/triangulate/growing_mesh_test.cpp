#include "triangulate/mesh/growing_mesh.hpp"

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "support/seed.hpp"
#include "triangulate/mesh/delaunay.hpp"

namespace itin {
namespace {

/// Few columns and rows, so that much is collinear and cocircular.
std::vector<SelectedVertex> random_vertices(std::size_t count, int side, std::mt19937& random) {
  std::uniform_int_distribution<std::int32_t> coordinate(-side, side);
  std::set<Position> positions;
  while (positions.size() < count) positions.insert({coordinate(random), coordinate(random)});
  std::vector<SelectedVertex> vertices;
  for (const Position& p : positions) vertices.push_back({{p.x, p.y, 0}, 0, 0, 0});
  std::shuffle(vertices.begin(), vertices.end(), random);
  return vertices;
}

/// None crosses another; they may overlap, and pass through vertices.
std::vector<Delaunay::Constraint> random_segments(const std::vector<SelectedVertex>& vertices, int count,
                                                  std::mt19937& random) {
  std::uniform_int_distribution<std::uint32_t> any(0, static_cast<std::uint32_t>(vertices.size() - 1));
  std::vector<Delaunay::Constraint> segments;
  for (int i = 0; i < count; ++i) {
    const std::uint32_t a = any(random), b = any(random);
    const Position p = vertices[a].position(), q = vertices[b].position();
    const bool free = std::none_of(segments.begin(), segments.end(), [&](const Delaunay::Constraint& s) {
      const Position from = vertices[s.first].position(), to = vertices[s.second].position();
      return crosses(Segment{.ax = from.x, .ay = from.y, .bx = to.x, .by = to.y}, p, q);
    });
    if (a != b && free) segments.emplace_back(a, b);
  }
  return segments;
}

std::vector<std::array<std::uint32_t, 3>> sorted_triangles(const PlaneMesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> triangles = mesh.triangles;
  for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

/// Neighbours know each other by the edge between them, and agree on what it is part of.
void expect_linked(const PlaneMesh& mesh) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t n = mesh.neighbours[t][i];
      if (n == kNoTriangle) continue;
      int j = 0;
      while (j < 2 && mesh.neighbours[n][j] != t) ++j;
      ASSERT_EQ(mesh.neighbours[n][j], t);
      ASSERT_EQ(mesh.triangles[t][(i + 1) % 3], mesh.triangles[n][(j + 2) % 3]);
      ASSERT_EQ(mesh.triangles[t][(i + 2) % 3], mesh.triangles[n][(j + 1) % 3]);
      ASSERT_EQ(mesh.constrained[t] >> i & 9, mesh.constrained[n] >> j & 9);
    }
  }
}

TEST(GrowingMesh, EqualsTheTriangulationOfAllAtOnceInWhateverOrderItGrows) {
  std::mt19937 random(test::seed());
  for (int run = 0; run < 60; ++run) {
    const std::vector<SelectedVertex> vertices = random_vertices(20 + random() % 200, 8 << random() % 8, random);
    const auto segments = random_segments(vertices, static_cast<int>(random() % 60), random);
    Delaunay whole, first;
    std::vector<Position> positions;
    for (const SelectedVertex& v : vertices) positions.push_back(v.position());
    whole.insert(positions);
    whole.constrain(segments);
    positions.resize(6 + random() % 10);
    first.insert(positions);
    if (first.mesh().triangles.empty()) continue;

    std::vector<SelectedVertex> known(vertices.begin(), vertices.begin() + std::ssize(positions));
    GrowingMesh grown(known);
    grown.start(first.mesh());
    std::vector<Delaunay::Constraint> waiting = segments;
    const auto lay_some = [&](bool all) {
      std::erase_if(waiting, [&](const Delaunay::Constraint& s) {
        if (std::max(s.first, s.second) >= known.size() || (!all && random() % 3 != 0)) return false;
        grown.lay(s.first, s.second, 1);
        return true;
      });
    };
    while (known.size() < vertices.size()) {
      lay_some(false);
      known.push_back(vertices[known.size()]);
      grown.insert(static_cast<std::uint32_t>(known.size() - 1));
    }
    lay_some(true);
    ASSERT_EQ(sorted_triangles(grown.mesh()), sorted_triangles(whole.mesh())) << "run " << run;
    expect_linked(grown.mesh());
    for (const auto& [from, to] : segments) {
      std::vector<SegmentEdge> edges;
      grown.edges_of(from, to, 1, edges);
      for (const SegmentEdge& e : edges) {
        const std::uint32_t t = e.left != kNoTriangle ? e.left : e.right;
        ASSERT_NE(grown.mesh().constrained[t] & 7, 0);
      }
    }
  }
}

TEST(GrowingMesh, TellsWhichTrianglesChanged) {
  std::vector<SelectedVertex> vertices;
  for (const Position p : {Position{0, 0}, {10, 0}, {0, 10}, {10, 11}, {100, 0}, {100, 10}, {101, 5}})
    vertices.push_back({{p.x, p.y, 0}, 0, 0, 0});
  std::vector<Position> positions;
  for (const SelectedVertex& v : vertices) positions.push_back(v.position());
  Delaunay delaunay;
  delaunay.insert(positions);
  GrowingMesh grown(vertices);
  grown.start(delaunay.mesh());
  for (std::uint32_t t = 0; t < grown.mesh().triangles.size(); ++t) grown.mark_proved(t);
  EXPECT_TRUE(grown.take_changed().empty());
  vertices.push_back({{3, 3, 0}, 0, 0, 0});
  grown.insert(7);
  const std::vector<std::uint32_t> changed = grown.take_changed();
  EXPECT_TRUE(std::is_sorted(changed.begin(), changed.end()));
  for (std::uint32_t t = 0; t < grown.mesh().triangles.size(); ++t) {
    const auto& corners = grown.mesh().triangles[t];
    const bool has_it = std::find(corners.begin(), corners.end(), 7U) != corners.end();
    EXPECT_EQ(grown.is_proved(t), !has_it);
    EXPECT_EQ(std::count(changed.begin(), changed.end(), t), has_it ? 1 : 0);
  }
  EXPECT_TRUE(grown.take_changed().empty());
}

TEST(GrowingMesh, TellsTheStarThatReplacedTriangles) {
  std::mt19937 random(test::seed());
  for (int run = 0; run < 40; ++run) {
    // The corners of a square hold all others.
    std::vector<SelectedVertex> vertices = random_vertices(60, 4 << random() % 6, random);
    const std::int32_t side = 2000;
    for (const Position p : {Position{side, side}, {-side, side}, {-side, -side}, {side, -side}})
      vertices.insert(vertices.begin(), {{p.x, p.y, 0}, 0, 0, 0});
    Delaunay first;
    std::vector<Position> corners;
    for (int i = 0; i < 4; ++i) corners.push_back(vertices[i].position());
    first.insert(corners);
    GrowingMesh grown(vertices);
    grown.start(first.mesh());
    for (std::uint32_t v = 4; v < vertices.size(); ++v) {
      const auto before = grown.mesh().triangles;
      ASSERT_FALSE(grown.has(v));
      const std::uint32_t holds = grown.triangle_at(vertices[v].position());
      for (int i = 0; i < 3; ++i)
        ASSERT_GE(orientation(vertices[before[holds][i]].position(), vertices[before[holds][(i + 1) % 3]].position(),
                              vertices[v].position()),
                  0);
      grown.insert(v, holds);
      ASSERT_TRUE(grown.has(v));
      std::set<std::uint32_t> changed;
      for (std::uint32_t t = 0; t < grown.mesh().triangles.size(); ++t)
        if (t >= before.size() || grown.mesh().triangles[t] != before[t]) changed.insert(t);
      EXPECT_EQ(std::set<std::uint32_t>(grown.star().begin(), grown.star().end()), changed);
      for (const std::uint32_t t : grown.star()) EXPECT_EQ(grown.mesh().triangles[t][2], v);
      for (const std::uint32_t t : grown.replaced()) EXPECT_TRUE(changed.contains(t));
      expect_linked(grown.mesh());
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& t : grown.mesh().triangles)
      for (int i = 0; i < 3; ++i) edges.insert({t[i], t[(i + 1) % 3]}), edges.insert({t[(i + 1) % 3], t[i]});
    for (std::uint32_t a = 0; a < vertices.size(); ++a)
      for (std::uint32_t b = 0; b < vertices.size(); ++b) {
        if (a == b) continue;
        ASSERT_EQ(grown.has_edge(a, b), edges.contains({a, b})) << a << " " << b;
      }
  }
}

TEST(GrowingMesh, RefusesLinesThatCross) {
  std::vector<SelectedVertex> vertices;
  for (const Position p : {Position{0, 0}, {10, 0}, {0, 10}, {10, 11}}) vertices.push_back({{p.x, p.y, 0}, 0, 0, 0});
  Delaunay delaunay;
  delaunay.insert(
      std::array{vertices[0].position(), vertices[1].position(), vertices[2].position(), vertices[3].position()});
  GrowingMesh grown(vertices);
  grown.start(delaunay.mesh());
  grown.lay(0, 3, 1);
  EXPECT_ANY_THROW(grown.lay(1, 2, 1));
}

}  // namespace
}  // namespace itin
