// Sides of positions by a grid of cells, against the exact walk along all edges.
#include "features/plan/polygon_sides.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "features/plan/mask_index.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

GridRing random_ring(std::mt19937& random, std::int32_t side, unsigned corners, Position centre) {
  const auto in = [&] { return static_cast<std::int32_t>(random() % static_cast<unsigned>(side)) - side / 2; };
  GridRing ring;
  for (unsigned i = 0; i < corners; ++i) ring.push_back({centre.x + in(), centre.y + in()});
  return ring;
}

/// Long teeth side by side: every level line crosses all of them.
GridRing comb(std::int32_t teeth, std::int32_t length) {
  GridRing ring;
  for (std::int32_t i = 0; i < teeth; ++i) {
    ring.push_back({4 * i, length});
    ring.push_back({4 * i + 2, length});
    ring.push_back({4 * i + 2, 3});
    ring.push_back({4 * i + 4, 3});
  }
  ring.push_back({4 * teeth, 0});
  ring.push_back({0, 0});
  return ring;
}

/// By the even-odd rule along the level line to the right of what lies a little to the right of the middle, and above.
bool slowly_encloses_middle(const GridPolygon& polygon, Position p, Position q) {
  const std::int64_t x = std::int64_t{p.x} + q.x, y = std::int64_t{p.y} + q.y;
  bool inside = false;
  for_each_edge(polygon, [&](Position a, Position b) {
    if (b.y < a.y) std::swap(a, b);
    if ((2 * std::int64_t{a.y} > y) == (2 * std::int64_t{b.y} > y)) return;
    const Int128 left = Int128{std::int64_t{b.x} - a.x} * (y - 2 * std::int64_t{a.y}),
                 right = Int128{std::int64_t{b.y} - a.y} * (x - 2 * std::int64_t{a.x});
    inside ^= left > right;
  });
  return inside;
}

void expect_same_sides(const GridPolygon& polygon, std::mt19937& random) {
  const PolygonSides sides(polygon);
  GridBox box;
  for_each_edge(polygon, [&](Position a, Position) { box.extend(a.x, a.y); });
  const auto between = [&](std::int32_t low, std::int32_t high) {
    return low + static_cast<std::int32_t>(random() % (static_cast<std::uint32_t>(high - low) + 1));
  };
  const auto anywhere = [&] {
    return Position{between(box.xmin - 2, box.xmax + 2), between(box.ymin - 2, box.ymax + 2)};
  };
  std::vector<Position> places;
  for (int i = 0; i < 60; ++i) places.push_back(anywhere());
  for_each_edge(polygon, [&](Position a, Position b) {
    places.push_back(a);
    places.push_back({a.x + between(-1, 1), a.y + between(-1, 1)});
    places.push_back({(a.x + b.x) / 2, (a.y + b.y) / 2});
  });
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Position p = places[i], q = places[random() % places.size()];
    ASSERT_EQ(static_cast<int>(sides.at(p)), static_cast<int>(side_of(polygon, p))) << p.x << ' ' << p.y;
    ASSERT_EQ(sides.encloses_middle(p, q), slowly_encloses_middle(polygon, p, q))
        << p.x << ' ' << p.y << ", " << q.x << ' ' << q.y;
  }
}

/// Segments along its sides have no parts beyond their ends: a terrain's edge may run along the edge of a footprint.
TEST(PolygonSides, PartsOfASegmentAlongASideEndWhereTheSideDoes) {
  const PolygonSides sides(GridPolygon{{{10, 10}, {30, 10}, {30, 20}, {20, 20}, {20, 30}, {10, 30}}, {}});
  for (const auto& [p, q] : {std::pair{Point2{20, 40}, Point2{20, 0}}, std::pair{Point2{20, 0}, Point2{20, 40}},
                             std::pair{Point2{0, 20}, Point2{40, 20}}, std::pair{Point2{10, 40}, Point2{10, 0}},
                             std::pair{Point2{30, 0}, Point2{30, 40}}, std::pair{Point2{0, 10}, Point2{40, 10}}}) {
    for (const auto& [from, to] : sides.inside_parts(p, q)) {
      for (const Point2& end : {from, to}) {
        EXPECT_GE(end.x, 10);
        EXPECT_LE(end.x, 30);
        EXPECT_GE(end.y, 10);
        EXPECT_LE(end.y, 30);
      }
    }
  }
  const auto through = sides.inside_parts({20, 40}, {20, 0});
  double length = 0;
  for (const auto& [from, to] : through) length += std::abs(from.y - to.y);
  EXPECT_GE(length, 10);
  EXPECT_LE(length, 20);
}

void expect_same_parts(const GridPolygon& polygon, std::mt19937& random) {
  const PolygonSides sides(polygon);
  const auto off = [&] { return static_cast<double>(random() % 4000) / 7 - 200; };
  const Point2 p{off(), off()}, q{off(), off()};
  double length = 0;
  for (const auto& [from, to] : sides.inside_parts(p, q)) length += std::hypot(to.x - from.x, to.y - from.y);
  // A sum over many short steps, each inside or not.
  const int steps = 20000;
  const double step = std::hypot(q.x - p.x, q.y - p.y) / steps;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps;
    if (covers({polygon}, {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)})) sum += step;
  }
  double corners = static_cast<double>(polygon.outline.size());
  for (const GridRing& hole : polygon.holes) corners += static_cast<double>(hole.size());
  EXPECT_NEAR(length, sum, corners * step);
}

TEST(PolygonSides, OfRandomPolygons) {
  std::mt19937 random(test::seed());
  for (int run = 0; run < 150; ++run) {
    const std::int32_t side = 8 << (random() % 24);
    const Position centre{static_cast<std::int32_t>(random() % 1000) - 500, static_cast<std::int32_t>(random() % 1000)};
    for (const GridPolygon& polygon : even_odd({random_ring(random, side, 3 + random() % 40, centre)}).polygons)
      ASSERT_NO_FATAL_FAILURE(expect_same_sides(polygon, random)) << "run " << run;
  }
}

TEST(PolygonSides, OfCombsAndHoles) {
  std::mt19937 random(test::seed());
  ASSERT_NO_FATAL_FAILURE(expect_same_sides({comb(3, 9), {}}, random));
  ASSERT_NO_FATAL_FAILURE(expect_same_sides({comb(2000, 5), {}}, random));
  ASSERT_NO_FATAL_FAILURE(expect_same_sides({comb(300, 40000), {}}, random));
  const GridRing outline{{0, 0}, {1000, 0}, {1000, 900}, {0, 900}};
  const GridRing hole{{10, 10}, {10, 800}, {500, 450}, {900, 10}};
  ASSERT_NO_FATAL_FAILURE(expect_same_sides({outline, {hole}}, random));
}

TEST(PolygonSides, OfTheWholeGrid) {
  std::mt19937 random(test::seed());
  constexpr std::int32_t low = -kGridHalfSide, high = kGridHalfSide - 1;
  const PolygonSides sides({{{low, low}, {high, low}, {high, high}, {low, high - 5}}, {}});
  EXPECT_EQ(sides.at({low, low}), Side::border);
  EXPECT_EQ(sides.at({high, high}), Side::border);
  EXPECT_EQ(sides.at({0, 0}), Side::inside);
  EXPECT_EQ(sides.at({low, high}), Side::outside);
  EXPECT_EQ(sides.at({0, high - 2}), Side::outside) << "the upper border slopes";
  EXPECT_EQ(sides.at({0, high - 3}), Side::inside);
}

TEST(PolygonSides, PartsOfSegmentsInside) {
  std::mt19937 random(test::seed());
  for (int run = 0; run < 40; ++run) {
    for (const GridPolygon& polygon : even_odd({random_ring(random, 500, 3 + random() % 30, {0, 0})}).polygons)
      expect_same_parts(polygon, random);
  }
}

TEST(MaskIndex, FindsTheFirstPolygon) {
  const GridPolygons polygons{{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}},
                              {{{10, 0}, {4000, 0}, {4000, 90}, {10, 90}}, {}}};
  const MaskIndex index(polygons);
  EXPECT_EQ(index.at({10, 5}), 0U);
  EXPECT_EQ(index.at({11, 5}), 1U);
  EXPECT_EQ(index.at({5, 11}), std::nullopt);
  EXPECT_FALSE(index.strictly_inside({10, 5}));
  EXPECT_TRUE(index.strictly_inside({2000, 5}));
  EXPECT_TRUE(index.encloses({3999.5, 89.5}));
  EXPECT_FALSE(index.encloses({3999.5, 90.5}));
}

}  // namespace
}  // namespace itin
