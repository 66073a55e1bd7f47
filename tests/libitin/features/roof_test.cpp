// Roofs against their definitions.
#include "features/mesh/roof.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "libitin/features/feature_fixture.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

using test::box_ring, test::expect_planar, test::heights, test::house, test::meshed;

const double kTan35 = std::tan(35 * 3.14159265358979323846 / 180);

RoofHeights total(double base, double ridge) {
  RoofHeights heights;
  heights.base = base;
  heights.ridge = ridge;
  heights.slope = kTan35;
  return heights;
}

GridPolygon rectangle(std::int32_t width, std::int32_t height) {
  return {{{0, 0}, {width, 0}, {width, height}, {0, height}}, {}};
}

std::set<GridPoint> vertices(const RoofLines& roof) {
  std::set<GridPoint> all;
  for (const RoofLine& line : roof.lines) all.insert({line.a, line.b});
  return all;
}

TEST(Roof, GablesRiseAtTheEnds) {
  const RoofLines roof = make_roof(RoofKind::gabled, rectangle(1000, 600), total(0, 900));
  const auto eaves = static_cast<std::int32_t>(std::lround(900 - 300 * kTan35));
  const std::set<GridPoint> expected{{0, 0, eaves},   {1000, 0, eaves}, {1000, 600, eaves},
                                     {0, 600, eaves}, {0, 300, 900},    {1000, 300, 900}};
  EXPECT_EQ(vertices(roof), expected);
  EXPECT_EQ(std::count_if(roof.lines.begin(), roof.lines.end(), [](const RoofLine& l) { return !l.eaves; }), 1);
  EXPECT_EQ(roof.lines.size(), 7U);
}

TEST(Roof, IsNoSteeperThanHalfTheHeight) {
  const RoofLines roof = make_roof(RoofKind::gabled, rectangle(10000, 9000), total(100, 900));
  for (const GridPoint& p : vertices(roof)) EXPECT_TRUE(p.z == 900 || p.z == 500) << p.z;
}

TEST(Roof, TakesEavesAndRidgeAsGiven) {
  RoofHeights heights = total(0, 900);
  heights.eaves = 700;
  for (const RoofKind kind : {RoofKind::gabled, RoofKind::hipped, RoofKind::skeleton}) {
    for (const GridPoint& p : vertices(make_roof(kind, rectangle(1000, 600), heights)))
      EXPECT_TRUE(p.z == 700 || p.z == 900) << p.z;
  }
  heights.ridge.reset();
  for (const GridPoint& p : vertices(make_roof(RoofKind::hipped, rectangle(1000, 600), heights)))
    EXPECT_TRUE(p.z == 700 || p.z == 700 + std::lround(300 * kTan35)) << p.z;
}

// Over a rectangle both definitions name the same roof.
TEST(Roof, HippedIsTheSkeletonOverARectangle) {
  for (const auto& plan : {rectangle(1000, 600), rectangle(600, 1000), rectangle(800, 800),
                           GridPolygon{{{0, 0}, {800, 600}, {500, 1000}, {-300, 400}}, {}}}) {
    const std::set<GridPoint> hipped = vertices(make_roof(RoofKind::hipped, plan, total(0, 900)));
    const std::set<GridPoint> skeleton = vertices(make_roof(RoofKind::skeleton, plan, total(0, 900)));
    ASSERT_EQ(hipped.size(), skeleton.size());
    for (auto a = hipped.begin(), b = skeleton.begin(); a != hipped.end(); ++a, ++b) {
      EXPECT_LE(std::abs(a->x - b->x), 1);
      EXPECT_LE(std::abs(a->y - b->y), 1);
      EXPECT_LE(std::abs(a->z - b->z), 1);
    }
  }
}

// Every node of a straight skeleton is as far from its nearest side's line as it is high; on convex plans that is the
// distance from the outline.
TEST(Roof, SkeletonNodesAreAsHighAsTheyAreFarFromTheOutline) {
  std::mt19937 random(test::seed());
  int tried = 0;
  for (int round = 0; round < 300; ++round) {
    GridRing ring;
    std::uniform_real_distribution<double> turn(0, 2 * 3.14159265358979);
    std::vector<double> angles;
    for (int i = 0; i < 7; ++i) angles.push_back(turn(random));
    std::sort(angles.begin(), angles.end());
    // Rounding must not make corners reflex.
    const auto close = [](double a, double b) { return b - a < 0.1; };
    if (std::adjacent_find(angles.begin(), angles.end(), close) != angles.end()) continue;
    if (angles.front() + 2 * 3.14159265358979 - angles.back() < 0.1) continue;
    for (const double a : angles)
      ring.push_back({static_cast<std::int32_t>(2000 * std::cos(a)), static_cast<std::int32_t>(1200 * std::sin(a))});
    const GridPolygon plan{ring, {}};
    if (area(plan) < 1e5) continue;
    RoofHeights heights;
    heights.eaves = 0;
    heights.slope = 1;
    const RoofLines roof = make_roof(RoofKind::skeleton, plan, heights);
    ASSERT_EQ(roof.fallback, "");
    ++tried;
    for (const GridPoint& p : vertices(roof)) {
      double nearest = INFINITY;
      for_each_edge(plan, [&](Position a, Position b) {
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        nearest = std::min(nearest, static_cast<double>(doubled_area(a, b, p)) / length);
      });
      ASSERT_NEAR(p.z, nearest, 1.5);
    }
  }
  EXPECT_GT(tried, 50);
}

TEST(Roof, SkeletonGoesRoundACourtyard) {
  const FeatureMesh mesh =
      meshed({house("court", {box_ring(0, 0, 20, 20), box_ring(6, 6, 14, 14)}, 0, 10, RoofKind::skeleton)});
  expect_planar(mesh);
  EXPECT_EQ(mesh.flat_instead, 0U);
  const auto [low, high] = heights(mesh, 0, SegmentClass::roof);
  EXPECT_NEAR(high, 10, 0.011);
  EXPECT_NEAR(low, 10 - 2.95 * kTan35, 0.02);
}

// A courtyard that touches the outline at (12, 18) made CGAL crash.
TEST(Roof, FallsBackWhereRingsTouch) {
  const GridPolygon plan{{{4, 15},
                          {5, 16},
                          {6, 16},
                          {8, 17},
                          {12, 18},
                          {17, 15},
                          {28, 19},
                          {30, 24},
                          {23, 26},
                          {15, 26},
                          {7, 27},
                          {-5, 28},
                          {-6, 28},
                          {1, 20},
                          {2, 18}},
                         {{{12, 18}, {9, 20}, {8, 20}, {5, 22}, {-4, 27}, {7, 25}, {11, 24}, {22, 22}}}};
  const RoofLines roof = make_roof(RoofKind::skeleton, plan, total(0, 900));
  EXPECT_EQ(roof.fallback, "its outline touches itself");
  for (const GridPoint& p : vertices(roof)) EXPECT_EQ(p.z, 900);
}

}  // namespace
}  // namespace itin
