// Which positions are on the ground of some sources, against the triangulation of all their points at once.
#include "pyramid/coverage/grounded.hpp"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "support/points.hpp"
#include "support/seed.hpp"
#include "triangulate/mesh/delaunay.hpp"

namespace itin {
namespace {

using test::Pattern;

constexpr std::uint16_t kOthers = 0, kGround = 1;

/// Two sources: ground here and there, and others about it and between.
std::vector<RawPoint> points_of_two(Pattern pattern, double gap, std::mt19937& random) {
  std::vector<GridPoint> points = test::make_points(pattern, 200 + static_cast<int>(random() % 800), random);
  const GridPoint island = points[random() % points.size()], hole = points[random() % points.size()];
  const auto near = [&](const GridPoint& p, const GridPoint& centre, double gaps) {
    return std::hypot(double{1} * p.x - centre.x, double{1} * p.y - centre.y) < gaps * gap;
  };
  std::vector<RawPoint> raw;
  for (const GridPoint& p : points) {
    const bool ground = near(p, island, 8) && !near(p, hole, 3) && random() % 20 != 0;
    raw.push_back({morton(p.x, p.y), p.z, ground ? kGround : kOthers, 0});
  }
  return raw;
}

SortedPoints sorted(const std::vector<RawPoint>& points) {
  PointSorter sorter("/tmp", 1 << 24);
  sorter.add(points);
  NoProgress progress;
  return sorter.finish(std::array{SourceRank{1.0}, SourceRank{1.0}}, progress);
}

/// By all triangles of all ground.
std::vector<std::uint64_t> by_brute_force(const std::vector<std::uint64_t>& codes, const std::vector<RawPoint>& points,
                                          double gap) {
  std::vector<Position> ground;
  for (const RawPoint& p : points)
    if (p.source == kGround) ground.push_back({morton_x(p.code), morton_y(p.code)});
  Delaunay delaunay;
  delaunay.insert(ground);
  const auto bridges = [&](Position p, Position q) {
    return std::abs(double{1} * p.x - q.x) <= gap && std::abs(double{1} * p.y - q.y) <= gap;
  };
  std::set<std::uint64_t> result;
  for (const auto& t : delaunay.mesh().triangles) {
    const Position a = ground[t[0]], b = ground[t[1]], c = ground[t[2]];
    if (!bridges(a, b) || !bridges(b, c) || !bridges(c, a)) continue;
    for (const std::uint64_t code : codes) {
      const Position p{morton_x(code), morton_y(code)};
      if (orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0) result.insert(code);
    }
  }
  return {result.begin(), result.end()};
}

class Grounded : public testing::TestWithParam<Pattern> {};

TEST_P(Grounded, IsWhatTheTriangulationOfAllGroundSays) {
  std::mt19937 random(test::seed() + static_cast<unsigned>(GetParam()));
  for (int run = 0; run < 20; ++run) {
    const double gap = GetParam() == Pattern::kRandom ? 6000 : GetParam() == Pattern::kClusters ? 900 : 160;
    const std::vector<RawPoint> points = points_of_two(GetParam(), gap, random);
    SortedPoints file = sorted(points);
    const WorkingIndex index(file, 1, 1 + static_cast<std::uint32_t>(random() % 40));
    const Sources sources{kGround};
    const SourceIndex ground(index, sources);
    for (int window = 0; window < 10; ++window) {
      // Posts, of either source, and places between about one of them.
      const RawPoint& centre = points[random() % points.size()];
      const auto side = static_cast<std::int32_t>(gap * static_cast<double>(1 + random() % 12));
      std::vector<std::uint64_t> codes;
      for (const RawPoint& p : points) {
        if (std::abs(morton_x(p.code) - morton_x(centre.code)) < side &&
            std::abs(morton_y(p.code) - morton_y(centre.code)) < side)
          codes.push_back(p.code);
      }
      const auto about = [&](std::int32_t v) {
        return v + static_cast<std::int32_t>(random() % static_cast<unsigned>(2 * side)) - side;
      };
      for (int i = 0; i < 40; ++i) codes.push_back(morton(about(morton_x(centre.code)), about(morton_y(centre.code))));
      std::sort(codes.begin(), codes.end());
      ASSERT_EQ(grounded(codes, ground, {{gap, 0, 0, gap}, {gap, 0, 0, gap}}), by_brute_force(codes, points, gap))
          << "run " << run << ", window " << window << ", seed " << test::seed();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Patterns, Grounded,
                         testing::Values(Pattern::kRandom, Pattern::kLattice, Pattern::kClusters, Pattern::kContours,
                                         Pattern::kCollinear, Pattern::kCocircular, Pattern::kGappyLattice,
                                         Pattern::kTurnedLattice));

}  // namespace
}  // namespace itin
