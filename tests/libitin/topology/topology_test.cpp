// Each answer against its definition, applied to all pairs.
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

void check_triangles(const Tin& tin) {
  const auto adjacent = adjacent_triangles(tin);
  ASSERT_EQ(adjacent.size(), tin.triangles.size());
  for (Index t = 0; t < tin.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) ASSERT_EQ(adjacent[t][i], triangle_across(tin, t, i).value_or(kNoNeighbour));
}

std::size_t triangles_at_edge(const Tin& tin, Index a, Index b) {
  return static_cast<std::size_t>(std::count_if(tin.triangles.begin(), tin.triangles.end(),
                                                [&](const Triangle& t) { return uses(t, a) && uses(t, b); }));
}

void check_vertices(const Tin& tin, const Topology& topology) {
  const auto edges = index_edges_of(tin);
  for (Index v = 0; v < tin.vertices.size(); ++v) {
    const auto neighbours = topology.vertices_of_vertex(v);
    Set expected;
    for (const auto& [a, b] : edges)
      if (a == v || b == v) expected.insert(a == v ? b : a);
    ASSERT_EQ(as_set(neighbours), expected);
    ASSERT_TRUE(counterclockwise(tin, v, neighbours)) << v;
    const auto ends_a_fan = [&](Index neighbour) { return triangles_at_edge(tin, v, neighbour) == 1; };
    const bool boundary = std::any_of(neighbours.begin(), neighbours.end(), ends_a_fan);
    ASSERT_EQ(topology.on_boundary(v), boundary);
    if (boundary) {
      EXPECT_TRUE(ends_a_fan(neighbours.front())) << "begins inside";
      EXPECT_TRUE(ends_a_fan(neighbours.back())) << "ends inside";
    }
    // Each triangle lies between two neighbours that follow each other.
    std::size_t between = 0, triangles = 0;
    for (const Triangle& t : tin.triangles) {
      if (!uses(t, v)) continue;
      ++triangles;
      for (std::size_t n = 0; n < neighbours.size(); ++n)
        between += uses(t, neighbours[n]) && uses(t, neighbours[(n + 1) % neighbours.size()]) && neighbours.size() > 1;
    }
    // Two neighbours follow each other both ways round.
    ASSERT_EQ(between, neighbours.size() == 2 ? 2 * triangles : triangles) << "a triangle's corners are apart";
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
    }
  }
}

void check(const Tin& tin) {
  const Topology topology(tin);
  check_half_edges(tin, topology);
  check_triangles(tin);
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
    for (Index v = 0; v < topology.vertex_count(); ++v) {
      const auto triangles =
          std::count_if(tin.triangles.begin(), tin.triangles.end(), [&](const Triangle& t) { return uses(t, v); });
      several_fans += topology.vertices_of_vertex(v).size() > static_cast<std::size_t>(triangles) + 1;
    }
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
  EXPECT_TRUE(Topology(one).on_boundary(0));
  const Tin empty;
  const Topology none(empty);
  EXPECT_EQ(none.half_edge_count(), 0u);
}

}  // namespace
}  // namespace itin
