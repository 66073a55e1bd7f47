// Paths as they are written against the points that they are drawn through.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include <gtest/gtest.h>

#include <itin/svg_path.hpp>

#include "support/seed.hpp"

namespace itin {

namespace {

/// The points of a path of one M and one l, read by the grammar of SVG: a sign or a second point begins a number.
std::vector<Point2> points_of(const std::string& path) {
  std::string apart;
  bool fraction = false;
  for (const char c : path) {
    const bool letter = std::isalpha(static_cast<unsigned char>(c)) != 0;
    if (letter || c == '-' || (c == '.' && fraction)) apart += ' ';
    if (!letter) apart += c;
    fraction = c == '.' || (fraction && std::isdigit(static_cast<unsigned char>(c)));
  }
  std::istringstream numbers(apart);
  std::vector<Point2> points;
  for (Point2 step; numbers >> step.x >> step.y;)
    points.push_back(points.empty() ? step : Point2{points.back().x + step.x, points.back().y + step.y});
  return points;
}

double distance_between(Point2 p, Point2 a, Point2 b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
  const double share = length > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - share * dx, p.y - a.y - share * dy);
}

TEST(SvgPath, StaysWithinItsToleranceAndStep) {
  std::mt19937 random(test::seed());
  for (const SvgPrecision precision : {SvgPrecision{0.07, 0.01}, {0, 0.1}, {1, 1}}) {
    std::normal_distribution<double> step(0, 3 * precision.step);
    std::vector<Point2> line{{88, 271.4296}};
    for (int i = 1; i < 2000; ++i) line.push_back({line.back().x + step(random), line.back().y + step(random)});
    const std::string path = svg_path(line, precision);
    ASSERT_TRUE(path.starts_with("M"));
    const std::vector<Point2> drawn = points_of(path);
    ASSERT_GE(drawn.size(), 2U);
    EXPECT_LE(path.size(), 12 * drawn.size() + 20);
    for (const Point2& p : line) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i + 1 < drawn.size(); ++i)
        least = std::min(least, distance_between(p, drawn[i], drawn[i + 1]));
      EXPECT_LE(least, precision.tolerance + precision.step);
    }
    // Rounding does not add up.
    EXPECT_NEAR(drawn.back().x, line.back().x, 0.501 * precision.step);
    EXPECT_NEAR(drawn.back().y, line.back().y, 0.501 * precision.step);
  }
}

TEST(SvgPath, IsShort) {
  EXPECT_EQ(svg_path(std::vector<Point2>{{0, 0}, {200, 0}, {200, 100.004}, {199.5, 99.5}}, {0, 0.01}),
            "M0 0l200 0 0 100-.5-.5");
  EXPECT_EQ(svg_path(std::vector<Point2>{{3, 4}}, {}), "M3 4l0 0");
  EXPECT_EQ(svg_path(std::vector<Point2>{}, {}), "");
  EXPECT_EQ(svg_number(-0.001, 0.01), "0");
  EXPECT_EQ(svg_number(-10.256, 0.01), "-10.26");
}

}  // namespace

}  // namespace itin
