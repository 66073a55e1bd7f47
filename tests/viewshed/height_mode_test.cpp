// The least visible height of every cell, against bisection with the exact line of sight.
#include <cmath>
#include <gmock/gmock.h>
#include <limits>

#include <gtest/gtest.h>

#include <viewshed/result.hpp>

#include "support/exact_line_of_sight.hpp"
#include "support/real_terrain.hpp"
#include "support/terrain_tin.hpp"
#include "support/viewshed_of.hpp"

namespace itin::viewshed {
namespace {

using test::kCorner;

using test::run;

Request look(const std::vector<Point2>& from, double cell) {
  Request request;
  request.mode = Mode::kHeight;
  request.cell_size = cell;
  request.target_height = 3;
  for (const Point2 p : from) request.observers.push_back({"", p, 2});
  return request;
}

class Bisection {
 public:
  Bisection(const Tin& tin, const Request& request) : request_(request), exact_(tin, request.earth) {}

  std::optional<double> ground(Point2 p) const { return exact_.height(p); }

  /// Metres above the ground, to a tenth of a millimetre: bisection is the slow way.
  double least_height(Point2 centre) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Observer& o : request_.observers) {
      const Point3 eye{o.position.x, o.position.y, *exact_.height(o.position) + o.height};
      const double ground = *exact_.height(centre);
      const auto seen = [&](double h) { return exact_.clearance(eye, {centre.x, centre.y, ground + h}) >= -1e-6; };
      double low = 0, high = 1;
      if (seen(0)) return 0;
      while (!seen(high)) high *= 4;
      while (high - low > 1e-4) (seen((low + high) / 2) ? high : low) = (low + high) / 2;
      least = std::min(least, high);
    }
    return least;
  }

 private:
  const Request& request_;
  test::ExactLineOfSight exact_;
};

void expect_exact(const Tin& tin, const Request& request) {
  const Result result = run(tin, request);
  const Bisection slow(tin, request);
  CellCounts cells;
  std::size_t between = 0;
  for (std::int64_t row = 0; row < result.grid.rows(); ++row) {
    for (std::int64_t column = 0; column < result.grid.columns(); ++column) {
      const Point2 centre = result.grid.centre(column, row);
      const std::size_t i = result.grid.index({column, row});
      if (!slow.ground(centre)) {
        EXPECT_TRUE(std::isnan(result.get<LeastHeights>().height_m[i]));
        ++cells.outside;
        continue;
      }
      const double expected = slow.least_height(centre);
      // Where the line grazes near the eye, a micrometre there is more at the target.
      ASSERT_NEAR(result.get<LeastHeights>().height_m[i], expected, 1e-3 + 1e-6 * expected)
          << centre.x << "," << centre.y;
      EXPECT_EQ(result.get<LeastHeights>().height_m[i] == 0, expected == 0);
      const bool doubtful = expected > 0 && std::abs(expected - request.target_height) < 1e-3;
      const bool visible = doubtful ? result.visible[i] == Verdict::kVisible : expected <= request.target_height;
      EXPECT_EQ(result.visible[i], visible ? Verdict::kVisible : Verdict::kHidden);
      ++(visible ? cells.visible : cells.hidden);
      between += expected > 0 && expected <= request.target_height;
    }
  }
  EXPECT_EQ(result.cells.visible, cells.visible);
  EXPECT_EQ(result.cells.hidden, cells.hidden);
  EXPECT_EQ(result.cells.outside, cells.outside);
  EXPECT_EQ(between > 0, request.target_height > 0);
}

TEST(HeightMode, IsExactOnHills) {
  const Tin tin = test::fractal_tin(33, 50, 60, 0.55, 5);
  Request request = look({{kCorner.x + 803, kCorner.y + 798}}, 90);
  expect_exact(tin, request);
  request.target_height = 0;
  expect_exact(tin, request);
}

TEST(HeightMode, OfSeveralObserversTheLeast) {
  const Tin tin = test::fractal_tin(33, 50, 60, 0.55, 6);
  Request request = look({{kCorner.x + 303, kCorner.y + 498}, {kCorner.x + 1203, kCorner.y + 1198}}, 110);
  expect_exact(tin, request);
  // A target height given for one observer counts for that observer only.
  request.observers[1].target_height = 300;
  const Result result = run(tin, request);
  request.observers.erase(request.observers.begin());
  request.cell_size.reset();
  request.grid = result.grid;
  const Result second = run(tin, request);
  for (std::size_t i = 0; i < result.visible.size(); ++i) {
    if (second.get<LeastHeights>().height_m[i] <= 300) {
      EXPECT_EQ(result.visible[i], Verdict::kVisible);
    }
  }
}

TEST(HeightMode, IsExactOnRealTerrain) {
  const auto tin = test::big_tujunga(300, 300, 40);
  if (!tin) GTEST_SKIP() << "needs " << test::big_tujunga_path();
  const Box box = tin->bounds();
  expect_exact(*tin, look({{box.xmin + 0.47 * box.width(), box.ymin + 0.55 * box.height()}}, 75));
}

TEST(HeightMode, ElevationLimitsRaiseItOrHideTheCell) {
  const Tin plane = test::lattice_tin(41, 41, 10, [](std::int32_t, std::int32_t) { return 100.0; });
  Request request = look({{kCorner.x + 205, kCorner.y + 205}}, 10);
  request.earth = Earth::flat();
  request.elevation = AngleRange{0, 45};
  const Result result = run(plane, request);
  const auto at = [&](double dx, double dy) {
    return result.get<LeastHeights>()
        .height_m[result.grid.index(result.grid.cell_at({kCorner.x + dx, kCorner.y + dy}).value())];
  };
  EXPECT_NEAR(at(305, 205), 2, 1e-5);  // the eye's own height
  request.elevation = AngleRange{-90, -30};
  const Result down = run(plane, request);
  const std::size_t far = down.grid.index(down.grid.cell_at({kCorner.x + 305, kCorner.y + 205}).value());
  EXPECT_TRUE(std::isnan(down.get<LeastHeights>().height_m[far]));  // no target there, however high
  EXPECT_EQ(down.visible[far], Verdict::kOutside);
}

TEST(HeightMode, NoHeightIsSeenBehindMissingGroundThatBlocks) {
  const Tin tin = test::lattice_tin(
      41, 41, 10, [](std::int32_t c, std::int32_t) { return c > 18 && c < 22 ? std::nan("") : 100.0; });
  Request request = look({{kCorner.x + 105, kCorner.y + 205}}, 10);
  request.nodata = NoData::kBlock;
  const Result result = run(tin, request);
  const auto cell = [&](double dx) {
    return result.grid.index(result.grid.cell_at({kCorner.x + dx, kCorner.y + 205}).value());
  };
  EXPECT_EQ(result.get<LeastHeights>().height_m[cell(155)], 0);
  EXPECT_TRUE(std::isnan(result.get<LeastHeights>().height_m[cell(305)]));
  EXPECT_EQ(result.visible[cell(305)], Verdict::kHidden);
}

}  // namespace
}  // namespace itin::viewshed
