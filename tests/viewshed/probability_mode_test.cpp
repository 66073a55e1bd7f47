// The probability of visibility, against surfaces whose heights really err.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <viewshed/result.hpp>

#include "modes/lines/error_realisations.hpp"
#include "support/exact_line_of_sight.hpp"
#include "support/terrain_tin.hpp"
#include "support/viewshed_of.hpp"

namespace itin::viewshed {
namespace {

using test::kCorner;

using test::run;

/// Cholesky's root of the correlations of a Tin's vertices, row by row.
std::vector<std::vector<double>> root_of_correlations(const Tin& tin, double length) {
  std::vector<std::vector<double>> root(tin.vertices.size());
  for (std::size_t i = 0; i < root.size(); ++i) {
    root[i].resize(i + 1);
    for (std::size_t j = 0; j <= i; ++j) {
      const double d = std::hypot(tin.vertices[i].x - tin.vertices[j].x, tin.vertices[i].y - tin.vertices[j].y) *
                       tin.grid.resolution;
      double rest = i == j ? 1 : length == 0 ? 0 : std::exp(-d / length);
      for (std::size_t k = 0; k < j; ++k) rest -= root[i][k] * root[j][k];
      root[i][j] = i == j ? std::sqrt(rest) : rest / root[j][j];
    }
  }
  return root;
}

/// In what share of surfaces with errors each cell is seen.
std::vector<double> simulated(const Tin& tin, const Request& request, int surfaces) {
  const auto root = root_of_correlations(tin, request.vertical_error.correlation_length);
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  Request visible = request;
  visible.mode = Mode::kVisible;
  std::vector<double> share, independent(tin.vertices.size());
  for (int n = 0; n < surfaces; ++n) {
    for (double& e : independent) e = normal(random);
    Tin erring = tin;
    for (std::size_t i = 0; i < independent.size(); ++i) {
      double error = 0;
      for (std::size_t k = 0; k <= i; ++k) error += root[i][k] * independent[k];
      erring.vertices[i].z +=
          static_cast<std::int32_t>(std::lround(error * request.vertical_error.sigma / tin.grid.resolution));
    }
    const Result result = run(erring, visible);
    share.resize(result.visible.size());
    for (std::size_t i = 0; i < share.size(); ++i)
      share[i] += (result.visible[i] == Verdict::kVisible ? 1.0 : 0.0) / surfaces;
  }
  return share;
}

/// A target at a given elevation that the heights as they are bury counts as hidden.
bool below_ground(const Tin& tin, const Result& result, std::size_t cell) {
  if (!result.request.target_absolute) return false;
  const auto number = static_cast<std::int64_t>(cell);
  const Point2 centre = result.grid.centre(number % result.grid.columns(), number / result.grid.columns());
  return test::ExactLineOfSight(tin, {}).height(centre).value() > result.request.target_height;
}

void expect_as_simulated(const Tin& tin, const Request& request) {
  const Result result = run(tin, request);
  const std::vector<double> share = simulated(tin, request, 1500);
  double sum = 0, most = 0;
  int between = 0;
  for (std::size_t i = 0; i < share.size(); ++i) {
    if (result.visible[i] == Verdict::kOutside || below_ground(tin, result, i)) continue;
    const double difference = result.get<Probabilities>().probability[i] - share[i];
    most = std::max(most, std::abs(difference));
    if (share[i] > 0.02 && share[i] < 0.98) ++between, sum += difference;
  }
  // Standard errors of single cells: 0.022 at most, and 0.013 of what is simulated.
  EXPECT_LT(most, 0.08);
  ASSERT_GT(between, 30);
  EXPECT_LT(std::abs(sum / between), 0.012);
}

Request request_over(double sigma, double length) {
  Request request;
  request.mode = Mode::kProbability;
  request.vertical_error = {sigma, length};
  request.observers = {{"", {kCorner.x + 803, kCorner.y + 798}, 8}};
  request.target_height = 5;
  request.cell_size = 90;
  return request;
}

TEST(ProbabilityMode, IsTheShareOfSurfacesThatErrInWhichACellIsSeen) {
  const Tin tin = test::fractal_tin(17, 100, 60, 0.55, 5);
  for (const double length : {0.0, 120.0, 1000.0}) {
    SCOPED_TRACE(length);
    expect_as_simulated(tin, request_over(3, length));
  }
}

/// Where the whole line runs close above the ground, its worst place tells little.
TEST(ProbabilityMode, IsThatOfTheWholeLineOverAPlain) {
  const Tin tin = test::lattice_tin(17, 17, 100, [](std::int32_t, std::int32_t) { return 100.0; });
  for (const double length : {0.0, 500.0}) {
    SCOPED_TRACE(length);
    expect_as_simulated(tin, request_over(4, length));
  }
}

TEST(ProbabilityMode, DoesNotMoveEndsAtGivenElevations) {
  const Tin tin = test::fractal_tin(17, 100, 60, 0.55, 5);
  Request request = request_over(9, 0);
  const double eye = 5 + std::max_element(
                             tin.vertices.begin(), tin.vertices.end(),
                             [](const auto& a, const auto& b) {
                               return a.z < b.z;
                             })->z *
                             tin.grid.resolution;
  request.observers[0].height = eye, request.observers[0].absolute = true;
  request.target_height = eye - 20, request.target_absolute = true;
  expect_as_simulated(tin, request);
}

TEST(ProbabilityMode, IsAHalfAtMostWhereACellIsHidden) {
  const Tin tin = test::fractal_tin(33, 50, 60, 0.55, 11);
  Request request = request_over(0.5, 0);
  request.target_height = 2;
  request.cell_size = 20;
  request.observers.push_back({"", {kCorner.x + 303, kCorner.y + 398}, 5});
  const Result result = run(tin, request);
  std::size_t sure = 0, hidden = 0;
  for (std::size_t i = 0; i < result.get<Probabilities>().probability.size(); ++i) {
    ASSERT_EQ(result.visible[i] == Verdict::kOutside, std::isnan(result.get<Probabilities>().probability[i]));
    if (result.visible[i] == Verdict::kHidden) {
      ++hidden;
      EXPECT_LE(result.get<Probabilities>().probability[i], 0.57F);
    }
    sure += result.get<Probabilities>().probability[i] < 0.01F || result.get<Probabilities>().probability[i] > 0.99F
                ? 1
                : 0;
  }
  EXPECT_GT(hidden, 100);
  EXPECT_GT(sure, result.get<Probabilities>().probability.size() / 3);
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

TEST(ErrorRealisations, AreNormalAndIndependent) {
  const ErrorRealisations worlds;
  constexpr auto kCount = static_cast<double>(ErrorRealisations::kCount);
  double squares = 0;
  constexpr int kPairs = 400;
  for (std::uint64_t number = 0; number < kPairs; ++number) {
    const auto a = worlds.of(number), b = worlds.of(number + 1);
    double mean = 0, variance = 0, together = 0;
    for (std::size_t w = 0; w < a.size(); ++w)
      mean += a[w] / kCount, variance += a[w] * a[w] / kCount, together += a[w] * b[w] / kCount;
    EXPECT_NEAR(mean, 0, 1e-6);
    EXPECT_NEAR(variance, 1, 0.01);
    EXPECT_LT(std::abs(together), 0.25);
    squares += together * together / kPairs;
  }
  // Correlations of so many independent draws.
  EXPECT_NEAR(std::sqrt(squares), 1 / std::sqrt(kCount), 0.01);
}

}  // namespace
}  // namespace itin::viewshed
