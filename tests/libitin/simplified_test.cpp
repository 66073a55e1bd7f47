#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <itin/simplified.hpp>

namespace itin {

namespace {

double distance(Point2 p, Point2 a, Point2 b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
  const double share = length > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - share * dx, p.y - a.y - share * dy);
}

TEST(Simplified, KeepsEveryPointWithinTheTolerance) {
  std::mt19937 random(7);
  std::normal_distribution<double> step(0, 0.05);
  std::vector<Point2> line{{0, 0}};
  for (int i = 1; i < 2000; ++i) line.push_back({0.1 * i, line.back().y + step(random)});
  const std::vector<Point2> kept = simplified(line, 0.2);
  EXPECT_LT(kept.size(), line.size() / 4);
  EXPECT_EQ(kept.front().x, line.front().x);
  EXPECT_EQ(kept.back().x, line.back().x);
  for (const Point2& p : line) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < kept.size(); ++i) least = std::min(least, distance(p, kept[i], kept[i + 1]));
    EXPECT_LE(least, 0.2);
  }
}

TEST(Simplified, LeavesOutWhatLiesOnALine) {
  const std::vector<Point2> line{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 3}};
  EXPECT_EQ(simplified(line, 1e-6).size(), 3U);
  EXPECT_EQ(simplified(std::vector<Point2>{{1, 1}}, 1).size(), 1U);
}

}  // namespace

}  // namespace itin
