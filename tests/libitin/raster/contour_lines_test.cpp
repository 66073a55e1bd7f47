#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <itin/contour_lines.hpp>

namespace itin {

namespace {

template <class Height>
std::vector<float> heights(const RasterGrid& grid, const Height& height) {
  std::vector<float> values(grid.cell_count());
  for (std::int64_t row = 0; row < grid.rows(); ++row)
    for (std::int64_t column = 0; column < grid.columns(); ++column)
      values[grid.index({column, row})] = static_cast<float>(height(grid.centre(column, row)));
  return values;
}

double twice_area(const std::vector<Point2>& ring) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) sum += ring[i].x * ring[i + 1].y - ring[i + 1].x * ring[i].y;
  return sum;
}

TEST(ContourLines, AConeHasCirclesWithTheTopOnTheirLeft) {
  const RasterGrid grid({0, 100}, 1, 1, 100, 100);
  const auto cone = heights(grid, [](Point2 p) { return 60 - std::hypot(p.x - 50, p.y - 50); });
  const auto lines = contour_lines(grid, cone, 30);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].front().x, lines[0].back().x);
  EXPECT_EQ(lines[0].front().y, lines[0].back().y);
  for (const Point2& p : lines[0]) EXPECT_NEAR(std::hypot(p.x - 50, p.y - 50), 30, 0.02);
  EXPECT_NEAR(twice_area(lines[0]) / 2, 3.14159 * 900, 5);
}

TEST(ContourLines, APlaneHasOneLineFromEdgeToEdge) {
  const RasterGrid grid({0, 10}, 1, 1, 20, 10);
  const auto plane = heights(grid, [](Point2 p) { return p.x; });
  const auto lines = contour_lines(grid, plane, 7.25);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].size(), 12U);  // the centres of ten rows, and the edges
  for (const Point2& p : lines[0]) EXPECT_NEAR(p.x, 7.25, 1e-6);
  EXPECT_EQ(std::abs(lines[0].front().y - lines[0].back().y), 10);
}

TEST(ContourLines, NothingCrossesMissingValues) {
  const RasterGrid grid({0, 10}, 1, 1, 20, 10);
  auto plane = heights(grid, [](Point2 p) { return p.x; });
  plane[grid.index({7, 5})] = std::numeric_limits<float>::quiet_NaN();
  const auto lines = contour_lines(grid, plane, 7.25);
  ASSERT_EQ(lines.size(), 2U);
  // Both end where the square about the missing centre begins.
  for (const auto& line : lines) {
    for (const Point2& p : line) EXPECT_GE(std::max(std::abs(p.x - 7.5), std::abs(p.y - 4.5)), 0.5);
    EXPECT_EQ(std::min(std::abs(line.front().y - 4.5), std::abs(line.back().y - 4.5)), 0.5);
  }
}

TEST(ContourLines, EveryCrossingOfASaddleIsUsedOnce) {
  const RasterGrid grid({0, 2}, 1, 1, 2, 2);
  for (const float other : {0.0F, 0.9F}) {
    const std::vector<float> saddle{1, other, other, 1};
    const auto lines = contour_lines(grid, saddle, 0.94);
    ASSERT_EQ(lines.size(), 2U);
    for (const auto& line : lines) EXPECT_EQ(line.size(), 4U);  // two crossings, and two places on the edges
  }
}

}  // namespace

}  // namespace itin
