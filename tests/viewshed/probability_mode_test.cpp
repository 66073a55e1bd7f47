// The probability of visibility, against samples along the line, and against heights that really err.
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <viewshed/viewshed.hpp>

#include "support/exact_line_of_sight.hpp"
#include "support/terrain_tin.hpp"
#include "support/viewshed_of.hpp"
#include "vertical_odds.hpp"

namespace itin::viewshed {
namespace {

constexpr Point2 kCorner{300000, 200000};

using test::run;

double correlation(double distance, double length) {
  return distance == 0 ? 1 : length == 0 ? 0 : std::exp(-distance / length);
}

/// Phi at the critical place, from many samples along the line.
double sampled(const test::ExactLineOfSight& exact, const Request& request, const Point3& eye, const Point3& target) {
  const double d = std::hypot(target.x - eye.x, target.y - eye.y), l = request.vertical_error.correlation_length;
  double least = 6;
  constexpr int kSamples = 1500;
  for (int i = 0; i <= kSamples; ++i) {
    const double s = static_cast<double>(i) / kSamples, t = 1 - s;
    const auto ground = exact.height({eye.x + s * (target.x - eye.x), eye.y + s * (target.y - eye.y)}, 1e-6);
    if (!ground) continue;
    const double clearance = eye.z + s * (target.z - eye.z) - *ground - request.earth.drop(d) * s * t;
    const auto r = [&](double x) { return l == 0 ? 0 : std::exp(-x / l); };
    const double variance = 1 + t * t + s * s - 2 * t * r(s * d) - 2 * s * r(t * d) + 2 * s * t * r(d);
    if (variance > 1e-9) least = std::min(least, clearance / (request.vertical_error.sigma * std::sqrt(variance)));
  }
  return least >= 6 ? 1 : std::erfc(-least / std::sqrt(2.0)) / 2;
}

TEST(ProbabilityMode, IsThatOfTheCriticalPlace) {
  const Tin tin = test::fractal_tin(17, 100, 60, 0.55, 5);
  const test::ExactLineOfSight exact(tin, {});
  for (const double length : {0.0, 400.0}) {
    Request request;
    request.mode = Mode::kProbability;
    request.vertical_error = {3, length};
    request.observers = {{"", {kCorner.x + 803, kCorner.y + 798}, 8}};
    request.target_height = 5;
    request.cell_size = 200;
    const Result result = run(tin, request);
    const Point2 o = request.observers[0].position;
    const Point3 eye{o.x, o.y, *exact.height(o) + 8};
    int between = 0;
    for (std::int64_t row = 0; row < result.grid.rows(); ++row) {
      for (std::int64_t column = 0; column < result.grid.columns(); ++column) {
        const Point2 c = result.grid.centre(column, row);
        const float p = result.probability[result.grid.index({column, row})];
        const auto ground = exact.height(c);
        ASSERT_EQ(std::isnan(p), !ground);
        if (!ground) continue;
        EXPECT_NEAR(p, sampled(exact, request, eye, {c.x, c.y, *ground + 5}), 0.01) << c.x << "," << c.y;
        between += p > 0.05 && p < 0.95 ? 1 : 0;
      }
    }
    EXPECT_GT(between, 4);
  }
}

/// A plain with a wall across it: the share of worlds in which the line clears the wall, with errors drawn for both
/// ends and for the wall.
TEST(ProbabilityMode, IsTheShareOfWorldsInWhichTheLineIsClear) {
  const Tin tin = test::lattice_tin(101, 21, 10, [](std::int32_t c, std::int32_t) { return c == 30 ? 104.0 : 100.0; });
  for (const double length : {0.0, 500.0}) {
    Request request;
    request.mode = Mode::kProbability;
    request.earth = Earth::flat();
    request.vertical_error = {1.5, length};
    request.observers = {{"", {kCorner.x + 105, kCorner.y + 105}, 6}};
    request.target_height = 6;
    request.cell_size = 10;
    const Result result = run(tin, request);
    const double d = 700, s = 195 / d;
    const std::size_t cell = result.grid.index(result.grid.cell_at({kCorner.x + 105 + d, kCorner.y + 105}).value());
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    // Errors of eye, wall and target with the model's correlations, by Cholesky.
    const double ew = correlation(s * d, length), et = correlation(d, length), wt = correlation((1 - s) * d, length);
    const double l11 = std::sqrt(1 - ew * ew), l21 = (wt - ew * et) / l11, l22 = std::sqrt(1 - et * et - l21 * l21);
    int clear = 0;
    constexpr int kWorlds = 400000;
    for (int i = 0; i < kWorlds; ++i) {
      const double a = normal(random), b = normal(random), c = normal(random);
      const double eye = 1.5 * a, wall = 1.5 * (ew * a + l11 * b), target = 1.5 * (et * a + l21 * b + l22 * c);
      clear += 106 + (1 - s) * eye + s * target > 104 + wall ? 1 : 0;
    }
    EXPECT_NEAR(result.probability[cell], static_cast<double>(clear) / kWorlds, 0.004) << length;
    EXPECT_GT(result.probability[cell], 0.6);
  }
}

TEST(ProbabilityMode, IsAHalfWhereTheVerdictChanges) {
  const Tin tin = test::fractal_tin(33, 50, 60, 0.55, 11);
  Request request;
  request.mode = Mode::kProbability;
  request.vertical_error = {0.5, 0};
  request.target_height = 2;
  request.cell_size = 20;
  request.observers = {{"", {kCorner.x + 803, kCorner.y + 798}, 5}, {"", {kCorner.x + 303, kCorner.y + 398}, 5}};
  const Result result = run(tin, request);
  std::size_t sure = 0;
  for (std::size_t i = 0; i < result.probability.size(); ++i) {
    if (result.visible[i] == kOutside) continue;
    if (result.visible[i] == kVisible) {
      EXPECT_GE(result.probability[i], 0.49F);
    }
    if (result.visible[i] == kHidden) {
      EXPECT_LE(result.probability[i], 0.5F);
    }
    sure += result.probability[i] < 0.01F || result.probability[i] > 0.99F ? 1 : 0;
  }
  EXPECT_GT(sure, result.probability.size() / 3);
}

TEST(ProbabilityMode, RefusesAnErrorThatIsNone) {
  const Tin tin = test::fractal_tin(5, 50, 60, 0.55, 11);
  Request request;
  request.mode = Mode::kProbability;
  request.observers = {{"", {kCorner.x + 103, kCorner.y + 98}, 5}};
  EXPECT_THROW(run(tin, request), InputError);
  request.vertical_error = {1, -1};
  EXPECT_THROW(run(tin, request), InputError);
}

}  // namespace
}  // namespace itin::viewshed
