// Every relation against its definition, applied to all pairs.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <itin/topology.hpp>

#include "support/delaunay_tin.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

using Index = std::uint32_t;
using Set = std::set<Index>;

bool uses(const Triangle& t, Index v) {
  return std::find(t.begin(), t.end(), v) != t.end();
}

std::set<std::pair<Index, Index>> index_edges_of(const Tin& tin) {
  std::set<std::pair<Index, Index>> edges;
  for (const Triangle& t : tin.triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
  return edges;
}

double azimuth(const Tin& tin, Index from, Index to) {
  const Point3 a = tin.point(from), b = tin.point(to);
  return std::atan2(b.y - a.y, b.x - a.x);
}

/// Whether one turn counterclockwise passes them all in their order.
bool counterclockwise(const Tin& tin, Index centre, std::span<const Index> around) {
  double total = 0;
  for (std::size_t i = 0; i < around.size(); ++i) {
    double step = azimuth(tin, centre, around[(i + 1) % around.size()]) - azimuth(tin, centre, around[i]);
    if (step <= 0) step += 2 * M_PI;
    total += step;
  }
  return around.size() < 2 || std::abs(total - 2 * M_PI) < 1e-6;
}

template <typename Range>
Set as_set(const Range& range) {
  const Set result(range.begin(), range.end());
  EXPECT_EQ(result.size(), static_cast<std::size_t>(range.end() - range.begin())) << "something is listed twice";
  return result;
}

/// Across the edge from corner i to the next.
std::optional<Index> triangle_across(const Tin& tin, Index t, std::size_t i) {
  const Index a = tin.triangles[t][i], b = tin.triangles[t][(i + 1) % 3];
  for (Index other = 0; other < tin.triangles.size(); ++other)
    if (other != t && uses(tin.triangles[other], a) && uses(tin.triangles[other], b)) return other;
  return std::nullopt;
}

void check_triangles(const Tin& tin, const Topology& topology) {
  const auto adjacent = adjacent_triangles(tin);
  ASSERT_EQ(adjacent.size(), tin.triangles.size());
  for (Index t = 0; t < tin.triangles.size(); ++t) {
    EXPECT_EQ(topology.vertices_of_triangle(t), tin.triangles[t]);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto expected = triangle_across(tin, t, i);
      ASSERT_EQ(topology.triangles_of_triangle(t)[i], expected);
      ASSERT_EQ(adjacent[t][i], expected.value_or(kNoNeighbour));
      const auto ends = topology.vertices_of_edge(topology.edges_of_triangle(t)[i]);
      ASSERT_EQ(std::minmax(ends[0], ends[1]), std::minmax(tin.triangles[t][i], tin.triangles[t][(i + 1) % 3]));
    }
  }
}

void check_edges(const Tin& tin, const Topology& topology) {
  ASSERT_EQ(topology.edge_count(), index_edges_of(tin).size());
  std::set<std::pair<Index, Index>> seen;
  Index before = 0;
  for (Index e = 0; e < topology.edge_count(); ++e) {
    const auto [a, b] = topology.vertices_of_edge(e);
    seen.insert(std::minmax(a, b));
    EXPECT_EQ(topology.edge(topology.half_edge(e)), e);
    EXPECT_TRUE(e == 0 || topology.half_edge(e) > before);
    before = topology.half_edge(e);

    Set triangles, expected_triangles;
    for (const auto t : topology.triangles_of_edge(e))
      if (t) triangles.insert(*t);
    for (Index t = 0; t < tin.triangles.size(); ++t)
      if (uses(tin.triangles[t], a) && uses(tin.triangles[t], b)) expected_triangles.insert(t);
    ASSERT_EQ(triangles, expected_triangles);

    std::vector<Index> edges;
    topology.edges_of_edge(e, edges);
    Set expected_edges;
    for (Index f = 0; f < topology.edge_count(); ++f) {
      const auto ends = topology.vertices_of_edge(f);
      if (f != e && (ends[0] == a || ends[0] == b || ends[1] == a || ends[1] == b)) expected_edges.insert(f);
    }
    ASSERT_EQ(as_set(edges), expected_edges);
  }
  EXPECT_EQ(seen, index_edges_of(tin));
}

void check_vertices(const Tin& tin, const Topology& topology) {
  const auto edges = index_edges_of(tin);
  for (Index v = 0; v < tin.vertices.size(); ++v) {
    const auto neighbours = topology.vertices_of_vertex(v);
    Set expected, expected_triangles;
    for (const auto& [a, b] : edges)
      if (a == v || b == v) expected.insert(a == v ? b : a);
    for (Index t = 0; t < tin.triangles.size(); ++t)
      if (uses(tin.triangles[t], v)) expected_triangles.insert(t);
    ASSERT_EQ(as_set(neighbours), expected);
    ASSERT_EQ(as_set(topology.triangles_of_vertex(v)), expected_triangles);
    ASSERT_TRUE(counterclockwise(tin, v, neighbours)) << v;

    const auto around = topology.edges_of_vertex(v);
    ASSERT_EQ(around.size(), neighbours.size());
    for (std::size_t i = 0; i < around.size(); ++i) {
      const auto ends = topology.vertices_of_edge(around[i]);
      ASSERT_EQ(std::minmax(ends[0], ends[1]), std::minmax(v, neighbours[i]));
    }
    const bool boundary = std::any_of(around.begin(), around.end(),
                                      [&](Index e) { return !topology.triangles_of_edge(e)[1].has_value(); });
    ASSERT_EQ(topology.on_boundary(v), boundary);
    if (boundary) {
      EXPECT_FALSE(topology.triangles_of_edge(around.front())[1].has_value()) << "begins inside";
      EXPECT_FALSE(topology.triangles_of_edge(around.back())[1].has_value()) << "ends inside";
    }
    // Each triangle lies between two neighbours that follow each other.
    std::size_t n = 0;
    for (const Index t : topology.triangles_of_vertex(v)) {
      while (n < neighbours.size() && !(uses(tin.triangles[t], neighbours[n]) &&
                                        uses(tin.triangles[t], neighbours[(n + 1) % neighbours.size()])))
        ++n;
      ASSERT_LT(n, neighbours.size()) << "triangles and neighbours are not in step";
      ++n;
    }
  }
}

void check_half_edges(const Tin& tin, const Topology& topology) {
  ASSERT_EQ(topology.half_edge_count(), 3 * tin.triangles.size());
  for (Index h = 0; h < topology.half_edge_count(); ++h) {
    EXPECT_EQ(topology.origin(h), tin.triangles[h / 3][h % 3]);
    EXPECT_EQ(Topology::face(Topology::next(h)), h / 3);
    EXPECT_EQ(Topology::previous(Topology::next(h)), h);
    EXPECT_EQ(topology.destination(h), topology.origin(Topology::next(h)));
    if (const auto twin = topology.twin(h)) {
      EXPECT_EQ(topology.twin(*twin), h);
      EXPECT_EQ(topology.origin(*twin), topology.destination(h));
      EXPECT_EQ(topology.edge(*twin), topology.edge(h));
    }
  }
}

void check(const Tin& tin) {
  const Topology topology(tin);
  check_half_edges(tin, topology);
  check_triangles(tin, topology);
  check_edges(tin, topology);
  check_vertices(tin, topology);
}

TEST(Topology, AgreesWithDefinitionsOnRandomTins) {
  std::mt19937 random(test::seed());
  int several_fans = 0;
  for (int i = 0; i < 40; ++i) {
    const Tin tin = test::random_tin(random, 5 + i * 3, i % 4 * 0.2);
    check(tin);
    if (HasFatalFailure()) return;
    const Topology topology(tin);
    for (Index v = 0; v < topology.vertex_count(); ++v)
      several_fans += topology.vertices_of_vertex(v).size() > topology.triangles_of_vertex(v).size() + 1;
  }
  EXPECT_GT(several_fans, 10) << "no vertex had its triangles cut into fans";
}

TEST(Topology, TakesNoTinThatIsGoneTheNextMoment) {
  static_assert(std::is_constructible_v<Topology, const Tin&>);
  static_assert(!std::is_constructible_v<Topology, Tin>);
}

TEST(Topology, LatticeWithStraightBoundaries) {
  std::vector<GridPoint> points;
  for (int x = 0; x < 7; ++x)
    for (int y = 0; y < 6; ++y) points.push_back({10 * x, 10 * y, x});
  const std::vector<std::uint16_t> sources(points.size(), 0);
  check(test::delaunay_tin({{0, 0}, 1}, points, sources, [](const auto& a, const auto& b, const auto& c) {
    return a.x + b.x + c.x < 60 || a.x + b.x + c.x > 130 || a.y == 30;
  }));
}

TEST(Topology, CornersOfTheGridAreOrderedExactly) {
  constexpr std::int32_t far = kGridHalfSide - 1;
  // Two fans about the origin, their directions nearly the same.
  check(test::canonical_tin(
      {{0, 0}, 1}, {{0, 0, 0}, {far, far, 0}, {far - 1, far, 0}, {-far, -far, 0}, {-far + 1, -far, 0}, {-far, far, 0}},
      std::vector<std::uint16_t>(6, 0), {{0, 1, 2}, {0, 3, 4}}));
}

TEST(Topology, OneTriangleAndNone) {
  const Tin one = test::canonical_tin({{0, 0}, 1}, {{0, 0, 0}, {5, 0, 0}, {0, 5, 0}}, {0, 0, 0}, {{0, 1, 2}});
  check(one);
  EXPECT_EQ(Topology(one).edge_count(), 3u);
  const Tin empty;
  const Topology none(empty);
  EXPECT_EQ(none.edge_count(), 0u);
}

}  // namespace
}  // namespace itin
