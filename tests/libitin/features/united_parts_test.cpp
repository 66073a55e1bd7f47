// The union of a feature's parts, against the parts that hold a place.
#include "features/mesh/united_parts.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "features/plan/plan_on_grid.hpp"
#include "libitin/features/feature_fixture.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

using test::box_ring;
using test::kFeatureGrid;

GridPolygons plan_of_parts(const std::vector<FeaturePart>& parts) {
  return plan_on_grid(united_parts(parts, kFeatureGrid).rings, kFeatureGrid)->polygons;
}

double square_metres(const GridPolygons& polygons) {
  return area(polygons) * kFeatureGrid.resolution * kFeatureGrid.resolution;
}

TEST(UnitedParts, CoverWhatAnyOfThemCovers) {
  const FeaturePart lying{box_ring(0, 0, 100, 30)}, standing{box_ring(0, 0, 30, 100)}, court{box_ring(40, 40, 60, 60)};
  EXPECT_DOUBLE_EQ(square_metres(plan_of_parts({lying, standing})), 5100);
  EXPECT_DOUBLE_EQ(square_metres(plan_of_parts({lying, lying})), 3000);
  EXPECT_DOUBLE_EQ(square_metres(plan_of_parts({{box_ring(0, 0, 100, 100)}, court})), 10000);
  EXPECT_DOUBLE_EQ(square_metres(plan_of_parts({{box_ring(0, 0, 100, 100), court.front()}, court})), 10000);
  EXPECT_DOUBLE_EQ(square_metres(plan_of_parts({lying, {box_ring(100, 0, 120, 30)}})), 3600) << "they touch";
}

TEST(UnitedParts, KeepAHoleHoweverItIsWound) {
  PlanRing hole = box_ring(10, 10, 20, 20);
  const FeaturePart elsewhere{box_ring(30, 0, 50, 40)};
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_DOUBLE_EQ(square_metres(plan_of_parts({{box_ring(0, 0, 40, 40), hole}, elsewhere})), 1900);
    std::reverse(hole.begin(), hole.end());
  }
}

TEST(UnitedParts, EncloseACourtyardBetweenThem) {
  const std::vector<FeaturePart> parts{
      {box_ring(0, 0, 50, 10)}, {box_ring(0, 40, 50, 50)}, {box_ring(0, 0, 10, 50)}, {box_ring(40, 0, 50, 50)}};
  const GridPolygons plan = plan_of_parts(parts);
  ASSERT_EQ(plan.size(), 1U);
  EXPECT_EQ(plan.front().holes.size(), 1U);
  EXPECT_DOUBLE_EQ(square_metres(plan), 1600);
}

TEST(UnitedParts, KeepTheirRingsWhereTheyAreApart) {
  const std::vector<FeaturePart> parts{{box_ring(0.0001, 0, 10, 10)}, {box_ring(20, 0, 30, 10)}};
  const UnitedParts united = united_parts(parts, kFeatureGrid);
  ASSERT_EQ(united.rings.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(united.rings[i][k].x, parts[i][0][k].x);
}

/// Whether a part holds a place, by the even-odd rule.
bool within(const std::vector<GridRing>& part, Point2 p) {
  bool inside = false;
  for (const GridRing& ring : part) inside ^= covers({{ring, {}}}, p);
  return inside;
}

bool near_an_edge(const std::vector<GridRing>& part, Point2 p) {
  bool near = false;
  for (const GridRing& ring : part) {
    for_each_edge({ring, {}}, [&](Position a, Position b) {
      const double x = 1.0 * b.x - a.x, y = 1.0 * b.y - a.y, square = x * x + y * y;
      const double t = square > 0 ? std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / square, 0.0, 1.0) : 0;
      near = near || std::hypot(p.x - a.x - t * x, p.y - a.y - t * y) < 3;
    });
  }
  return near;
}

TEST(UnitedParts, HoldThePlacesThatAPartHolds) {
  std::mt19937 random(test::seed());
  const auto in = [&](int side) { return static_cast<std::int32_t>(random() % static_cast<unsigned>(side)); };
  int inside = 0, outside = 0;
  for (int run = 0; run < 200; ++run) {
    std::vector<std::vector<GridRing>> parts(2 + random() % 4);
    for (std::vector<GridRing>& part : parts) {
      part.resize(1 + random() % 2);
      for (GridRing& ring : part)
        for (unsigned corners = 3 + random() % 5; corners > 0; --corners) ring.push_back({in(2000), in(2000)});
    }
    if (random() % 2 == 0) parts.push_back(parts.front());
    std::vector<FeaturePart> in_metres;
    for (const std::vector<GridRing>& part : parts) {
      FeaturePart& metres = in_metres.emplace_back();
      for (const GridRing& ring : part) {
        PlanRing& out = metres.emplace_back();
        for (const Position& p : ring) out.push_back(kFeatureGrid.position(p.x, p.y));
      }
    }
    const GridPolygons plan = plan_of_parts(in_metres);
    std::shuffle(in_metres.begin(), in_metres.end(), random);
    const auto in_another_order = united_parts(in_metres, kFeatureGrid).rings;
    EXPECT_EQ(area(plan_on_grid(in_another_order, kFeatureGrid)->polygons), area(plan));
    for (int k = 0; k < 50; ++k) {
      const Point2 p{in(2000) + 0.3, in(2000) + 0.4};
      if (std::any_of(parts.begin(), parts.end(), [&](const auto& part) { return near_an_edge(part, p); })) continue;
      const bool held = std::any_of(parts.begin(), parts.end(), [&](const auto& part) { return within(part, p); });
      ++(held ? inside : outside);
      EXPECT_EQ(covers(plan, p), held) << "run " << run << ", " << p.x << ", " << p.y << ", seed " << test::seed();
    }
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 500);
}

}  // namespace
}  // namespace itin
