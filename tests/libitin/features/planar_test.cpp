// Planarity against brute force: all pairs, all vertices.
#include "features/plan/planar.hpp"

#include <deque>
#include <iostream>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "features/plan/hot_pixel.hpp"
#include "support/seed.hpp"
#include "triangulate/apex/apex.hpp"

namespace itin {
namespace {

/// A vertex moves by at most half a step in x and in y.
constexpr double kHalfDiagonal = 0.70711;

double distance(const GridPoint& a, const GridPoint& b, double x, double y) {
  const double dx = static_cast<double>(b.x) - a.x, dy = static_cast<double>(b.y) - a.y;
  const double length = dx * dx + dy * dy;
  const double t = length == 0 ? 0 : std::clamp(((x - a.x) * dx + (y - a.y) * dy) / length, 0.0, 1.0);
  return std::hypot(a.x + t * dx - x, a.y + t * dy - y);
}
double distance(const OwnedSegment& s, const GridPoint& p) {
  return distance(s.a, s.b, p.x, p.y);
}

void expect_planar(const PlanarLines& lines) {
  const auto& v = lines.vertices;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::set<PlanarEdge> distinct(lines.edges.begin(), lines.edges.end());
  ASSERT_EQ(distinct.size(), lines.edges.size());
  for (const PlanarEdge& e : lines.edges) {
    ASSERT_LT(e.from, e.to);
    edges.insert({e.from, e.to});
  }
  std::set<std::uint32_t> used;
  for (const auto& [a, b] : edges) {
    used.insert({a, b});
    for (const auto& [c, d] : edges) {
      ASSERT_FALSE(crosses({v[a].x, v[a].y, v[b].x, v[b].y}, {v[c].x, v[c].y}, {v[d].x, v[d].y}));
    }
    for (std::uint32_t p = 0; p < v.size(); ++p) {
      ASSERT_TRUE(p == a || p == b || !on_segment(v[a], v[b], v[p]));
    }
  }
  ASSERT_EQ(used.size(), v.size());
  for (std::size_t i = 1; i < v.size(); ++i) ASSERT_LT(morton(v[i - 1].x, v[i - 1].y), morton(v[i].x, v[i].y));
}

/// Every segment has a way from end to end along its image, and every edge lies along some segment of its owner.
void expect_close(const std::vector<OwnedSegment>& segments, const PlanarLines& lines) {
  const auto& v = lines.vertices;
  std::map<std::pair<std::int32_t, std::int32_t>, std::uint32_t> number;
  for (std::uint32_t i = 0; i < v.size(); ++i) number[{v[i].x, v[i].y}] = i;
  for (const OwnedSegment& s : segments) {
    if (s.a.x == s.b.x && s.a.y == s.b.y) continue;
    const std::uint32_t start = number.at({s.a.x, s.a.y}), goal = number.at({s.b.x, s.b.y});
    std::set<std::uint32_t> reached{start};
    std::deque<std::uint32_t> queue{start};
    while (!queue.empty()) {
      const std::uint32_t at = queue.front();
      queue.pop_front();
      for (const PlanarEdge& e : lines.edges) {
        if (e.owner != s.owner || (e.from != at && e.to != at)) continue;
        const std::uint32_t next = e.from == at ? e.to : e.from;
        if (distance(s, v[next]) <= kHalfDiagonal && reached.insert(next).second) queue.push_back(next);
      }
    }
    ASSERT_TRUE(reached.contains(goal));
  }
  for (const PlanarEdge& e : lines.edges) {
    ASSERT_TRUE(std::any_of(segments.begin(), segments.end(), [&](const OwnedSegment& s) {
      return s.owner == e.owner && distance(s, v[e.from]) <= kHalfDiagonal && distance(s, v[e.to]) <= kHalfDiagonal;
    }));
  }
}

bool same(const PlanarLines& a, const PlanarLines& b) {
  return a.vertices == b.vertices && a.edges == b.edges;
}

void expect_sound(std::vector<OwnedSegment> segments, std::mt19937& random) {
  const PlanarLines lines = make_planar(segments);
  expect_planar(lines);
  expect_close(segments, lines);
  std::shuffle(segments.begin(), segments.end(), random);
  for (OwnedSegment& s : segments) {
    if (random() % 2) std::swap(s.a, s.b);
  }
  ASSERT_TRUE(same(lines, make_planar(segments))) << "depends on the order";
  // Rounding what is planar already, as a later import does, may move it once more, but adds no crossing.
  std::vector<OwnedSegment> again;
  for (const PlanarEdge& e : lines.edges) again.push_back({lines.vertices[e.from], lines.vertices[e.to], e.owner});
  const PlanarLines twice = make_planar(again);
  EXPECT_EQ(twice.crossings, 0u);
  EXPECT_EQ(twice.vertices.size(), lines.vertices.size());
  expect_planar(twice);
}

GridPoint random_point(std::mt19937& random, std::int32_t side) {
  const auto in = [&] { return static_cast<std::int32_t>(random() % static_cast<unsigned>(side)) - side / 2; };
  return {in(), in(), static_cast<std::int32_t>(random() % 1000)};
}

TEST(Planar, RandomSegmentsDenseAndSparse) {
  std::mt19937 random(test::seed());
  for (int run = 0; run < 300; ++run) {
    // From a few dozen pixels, where everything touches, to the whole grid.
    const std::int32_t side = 4 << (random() % 28);
    std::vector<OwnedSegment> segments;
    for (unsigned i = 2 + random() % 25; i > 0; --i) {
      segments.push_back(
          {random_point(random, side), random_point(random, side), static_cast<std::uint32_t>(random() % 3)});
    }
    expect_sound(segments, random);
    if (HasFatalFailure()) FAIL() << "run " << run << ", side " << side;
  }
}

TEST(Planar, BundlesOfNearlyParallelSegments) {
  std::mt19937 random(test::seed());
  for (int run = 0; run < 100; ++run) {
    std::vector<OwnedSegment> segments;
    const std::int32_t length = 20 << (random() % 10);
    for (unsigned i = 2 + random() % 12; i > 0; --i) {
      const auto jitter = [&] { return static_cast<std::int32_t>(random() % 7); };
      segments.push_back({{jitter(), jitter(), 0},
                          {length + jitter(), length / 3 + jitter(), 10},
                          static_cast<std::uint32_t>(random() % 2)});
    }
    expect_sound(segments, random);
    if (HasFatalFailure()) FAIL() << "run " << run;
  }
}

TEST(Planar, RandomPolygonsThatCrossThemselves) {
  std::mt19937 random(test::seed());
  for (int run = 0; run < 150; ++run) {
    const std::int32_t side = 6 << (random() % 16);
    std::vector<OwnedSegment> segments;
    for (std::uint32_t owner = 0; owner < 3; ++owner) {
      std::vector<GridPoint> ring;
      for (unsigned i = 3 + random() % 8; i > 0; --i) ring.push_back(random_point(random, side));
      // Spikes and repeated corners, as digitisers leave them.
      if (random() % 2) ring.push_back(ring.front());
      if (random() % 2) ring.insert(ring.begin() + 1, ring.back());
      for (std::size_t i = 0; i < ring.size(); ++i) segments.push_back({ring[i], ring[(i + 1) % ring.size()], owner});
    }
    expect_sound(segments, random);
    if (HasFatalFailure()) FAIL() << "run " << run << ", side " << side;
  }
}

TEST(Planar, TheGridsFarCorners) {
  std::mt19937 random(test::seed());
  constexpr std::int32_t low = -kGridHalfSide, high = kGridHalfSide - 1;
  const std::vector<OwnedSegment> segments{{{low, low, -9}, {high, high, 9}, 0},
                                           {{low, high, 5}, {high, low, 5}, 1},
                                           {{low, 0, 0}, {high, 1, 0}, 2},
                                           {{low, low, 0}, {high, low, 0}, 2}};
  expect_sound(segments, random);
}

TEST(Planar, CrossingGetsOneVertexAtTheFirstOwnersHeight) {
  const PlanarLines lines = make_planar({{{0, 0, 100}, {10, 10, 200}, 1}, {{0, 10, 0}, {10, 0, 50}, 2}});
  ASSERT_EQ(lines.vertices.size(), 5u);
  ASSERT_EQ(lines.edges.size(), 4u);
  EXPECT_EQ(lines.crossings, 1u);
  const auto middle = std::find_if(lines.vertices.begin(), lines.vertices.end(),
                                   [](const GridPoint& p) { return p.x == 5 && p.y == 5; });
  ASSERT_NE(middle, lines.vertices.end());
  EXPECT_EQ(middle->z, 150);
}

TEST(Planar, AnEndsHeightGoesBeforeAnInterpolatedOne) {
  // A T-junction: the second segment ends on the first one.
  const PlanarLines lines = make_planar({{{0, 0, 0}, {10, 0, 100}, 0}, {{4, 0, 7}, {4, 9, 7}, 0}});
  ASSERT_EQ(lines.edges.size(), 3u);
  for (const GridPoint& p : lines.vertices) {
    EXPECT_TRUE(p.x != 4 || p.y != 0 || p.z == 7) << p.z;
  }
}

TEST(Planar, OverlapsShareTheirEdges) {
  const PlanarLines lines =
      make_planar({{{0, 0, 0}, {10, 5, 0}, 0}, {{4, 2, 0}, {14, 7, 0}, 1}, {{4, 2, 0}, {4, 2, 9}, 2}});
  // 0-4 of owner 0, 4-10 of both, 10-14 of owner 1; the one without length leaves nothing but its height's claim.
  EXPECT_EQ(lines.vertices.size(), 4u);
  EXPECT_EQ(lines.edges.size(), 4u);
  EXPECT_EQ(lines.crossings, 0u);
}

TEST(Planar, NothingComesOfNothing) {
  EXPECT_TRUE(make_planar({}).edges.empty());
  const PlanarLines point = make_planar({{{1, 1, 1}, {1, 1, 1}, 0}});
  EXPECT_TRUE(point.vertices.empty());
  EXPECT_TRUE(point.edges.empty());
}

TEST(HotPixel, IsHalfOpen) {
  // Along x + 1/2 the segment lies in the pixels to the right.
  EXPECT_TRUE(meets_pixel({0, 0}, {1, 1}, {0, 0}));
  EXPECT_TRUE(meets_pixel({0, 0}, {1, 1}, {1, 1}));
  EXPECT_FALSE(meets_pixel({0, 0}, {1, 1}, {0, 1}));
  EXPECT_FALSE(meets_pixel({0, 0}, {1, 1}, {1, 0}));
  // Through (1/2, 1/2) and (-1/2, 3/2) downwards to the right: both corners belong to the pixel above and right.
  EXPECT_TRUE(meets_pixel({-1, 2}, {2, -1}, {0, 1}));
  EXPECT_TRUE(meets_pixel({-1, 2}, {2, -1}, {1, 1}));
  EXPECT_FALSE(meets_pixel({-1, 2}, {2, -1}, {0, 0}));
}

TEST(HotPixel, RoundsHalvesUpwards) {
  EXPECT_EQ(rounded_quotient(1, 2), 1);
  EXPECT_EQ(rounded_quotient(-1, 2), 0);
  EXPECT_EQ(rounded_quotient(-3, 2), -1);
  EXPECT_EQ(rounded_quotient(5, -3), -2);
  EXPECT_EQ(rounded_quotient(4, -3), -1);
}

}  // namespace
}  // namespace itin
