// Where turbines may stand, against rules applied point by point.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <viewshed/turbine_layout.hpp>

#include "support/seed.hpp"

namespace itin::viewshed {
namespace {

TEST(TurbineSpacing, IsLongAlongTheWindAndShortAcrossIt) {
  // From the west: five rotors of 100 m along x, three along y.
  const TurbineSpacing spacing{500, 300, 270};
  EXPECT_TRUE(spacing.keeps_apart({0, 0}, {500, 0}));
  EXPECT_FALSE(spacing.keeps_apart({0, 0}, {499, 0}));
  EXPECT_TRUE(spacing.keeps_apart({0, 0}, {0, 300}));
  EXPECT_FALSE(spacing.keeps_apart({0, 0}, {0, 299}));
  EXPECT_FALSE(spacing.keeps_apart({7, 7}, {7, 7}));
  const double x = 500 * std::cos(0.7), y = 300 * std::sin(0.7);
  EXPECT_TRUE(spacing.keeps_apart({0, 0}, {1.001 * x, 1.001 * y}));
  EXPECT_FALSE(spacing.keeps_apart({0, 0}, {0.999 * x, 0.999 * y}));
}

TEST(TurbineSpacing, TurnsWithTheWindAndHasNoDirection) {
  std::mt19937 random(test::seed());
  std::uniform_real_distribution<double> place(-700, 700), bearing(-360, 720);
  std::size_t apart = 0;
  for (int i = 0; i < 2000; ++i) {
    const Point2 a{place(random), place(random)}, b{place(random), place(random)};
    const double wind = bearing(random), turn = wind * std::acos(-1.0) / 180;
    const TurbineSpacing spacing{500, 300, wind};
    // Turned so that the wind comes from the north.
    const auto turned = [&](Point2 p) {
      return Point2{p.x * std::cos(turn) - p.y * std::sin(turn), p.x * std::sin(turn) + p.y * std::cos(turn)};
    };
    const bool keeps = spacing.keeps_apart(a, b);
    EXPECT_EQ(keeps, spacing.keeps_apart(b, a));
    EXPECT_EQ(keeps, (TurbineSpacing{500, 300, wind + 180}.keeps_apart(a, b)));
    EXPECT_EQ(keeps, (TurbineSpacing{500, 300, 0}.keeps_apart(turned(a), turned(b)))) << wind;
    apart += keeps;
  }
  EXPECT_GT(apart, 500U);
  EXPECT_LT(apart, 1900U);
}

/// The slow way: points along every edge, and inside by winding.
TEST(Dwellings, AreAsFarAsTheirNearestPoint) {
  std::mt19937 random(test::seed());
  std::uniform_real_distribution<double> place(0, 1000), size(5, 120), angle(0, 6.28);
  std::vector<Window::Polygon> houses;
  std::vector<Point2> outlines;
  for (int h = 0; h < 12; ++h) {
    const Point2 c{place(random), place(random)};
    const double w = size(random), d = size(random), t = angle(random);
    Window::Polygon house;
    for (const auto& [u, v] : {std::pair{-w, -d}, {w, -d}, {w, d}, {-w, d}})
      house.outer.push_back({c.x + u * std::cos(t) - v * std::sin(t), c.y + u * std::sin(t) + v * std::cos(t)});
    for (std::size_t i = 0; i < 4; ++i)
      for (int s = 0; s < 500; ++s)
        outlines.push_back({house.outer[i].x + s / 500.0 * (house.outer[(i + 1) % 4].x - house.outer[i].x),
                            house.outer[i].y + s / 500.0 * (house.outer[(i + 1) % 4].y - house.outer[i].y)});
    houses.push_back(house);
  }
  const Window window = Window::polygons(houses);
  const Dwellings polygons({}, window), points(outlines, std::nullopt);
  std::size_t near = 0;
  for (int i = 0; i < 400; ++i) {
    const Point2 p{place(random), place(random)};
    double least = window.contains(p) ? 0 : 1e9;
    for (const Point2& q : outlines) least = std::min(least, std::hypot(p.x - q.x, p.y - q.y));
    for (const double metres : {20.0, 80.0}) {
      if (std::abs(least - metres) < 0.5) continue;  // between the points of the slow way
      EXPECT_EQ(polygons.any_within(p, metres), least < metres) << p.x << ' ' << p.y;
      if (least > 0) {
        EXPECT_EQ(points.any_within(p, metres), least < metres);
      }
      near += least < metres;
    }
  }
  EXPECT_GT(near, 50U);
}

TEST(SpacedPositions, AreTheMiddlesOfSquaresInTheArea) {
  const Window area = Window::polygons({{{{103, 205}, {1920, 310}, {1500, 1990}, {250, 1600}}, {}}});
  const std::vector<Point2> places = spaced_positions(area, 100);
  std::size_t expected = 0;
  for (double y = 50; y < 2100; y += 100)
    for (double x = 50; x < 2100; x += 100) {
      if (!area.contains({x, y})) continue;
      ++expected;
      EXPECT_TRUE(
          std::any_of(places.begin(), places.end(), [&](Point2 p) { return std::hypot(p.x - x, p.y - y) < 1e-6; }));
    }
  EXPECT_EQ(places.size(), expected);
  EXPECT_GT(places.front().y, places.back().y);
  EXPECT_THROW(spaced_positions(area, 0.5), InputError);
  EXPECT_THROW(spaced_positions(area, 100000), InputError);
}

}  // namespace
}  // namespace itin::viewshed
