// The horizon of an observer, against exact lines of sight just above and just below it in every direction.
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <viewshed/horizon.hpp>

#include "support/exact_line_of_sight.hpp"
#include "support/real_terrain.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

using test::kCorner;
constexpr double kDegrees = 180 / std::numbers::pi;

Horizon run(const Tin& tin, const Request& request, const HorizonOptions& options) {
  NoProgress progress;
  return horizon(tin, tin, request, options, progress);
}

Request look(Point2 from, double height = 2) {
  Request request;
  request.observers = {{"o", from, height}};
  return request;
}

void expect_exact(const Tin& tin, const Request& request, double step) {
  const Horizon result = run(tin, request, {.step_deg = step, .targets = {}});
  const test::ExactLineOfSight exact(tin, request.earth);
  const Point2 o = request.observers[0].position;
  const Point3 eye{o.x, o.y, *exact.height(o) + request.observers[0].height};
  const Box box = tin.bounds();
  const double reach = request.radius.value_or(std::hypot(box.width(), box.height()));
  ASSERT_EQ(result.points.size(), static_cast<std::size_t>(std::lround(360 / step)));
  for (const HorizonPoint& p : result.points) {
    const double x = std::sin(p.azimuth_deg / kDegrees), y = std::cos(p.azimuth_deg / kDegrees);
    const auto clearance = [&](double elevation_deg) {
      const double rise = reach * std::tan(elevation_deg / kDegrees) + request.earth.drop(reach);
      return exact.clearance(eye, {o.x + x * reach, o.y + y * reach, eye.z + rise});
    };
    ASSERT_TRUE(p.sky);
    EXPECT_NEAR(clearance(p.sky->elevation_deg), 0, 5e-6) << p.azimuth_deg;
    EXPECT_GT(clearance(p.sky->elevation_deg + 1e-4), 0);
    EXPECT_LT(clearance(p.sky->elevation_deg - 1e-4), 0);
    // The place itself is on the surface, in that direction and at that elevation.
    const Point3& at = p.sky->position;
    const double distance = std::hypot(at.x - o.x, at.y - o.y);
    EXPECT_NEAR(distance, p.sky->distance_m, 1e-6 * distance + 1e-6);
    EXPECT_LE(distance, reach * (1 + 1e-9));
    EXPECT_NEAR(exact.height({at.x, at.y}, 1e-3).value(), at.z, 2e-3);
    EXPECT_NEAR(std::atan2(at.z - eye.z - request.earth.drop(distance), distance) * kDegrees, p.sky->elevation_deg,
                1e-4);
  }
}

TEST(Horizon, IsExactInEveryDirection) {
  const Tin tin = test::fractal_tin(33, 50, 60, 0.55, 5);
  expect_exact(tin, look({kCorner.x + 803, kCorner.y + 798}), 0.5);
  Request request = look({kCorner.x + 800, kCorner.y + 800}, 0);  // on a vertex, along edges
  request.radius = 400;
  expect_exact(tin, request, 1);
}

TEST(Horizon, IsExactOnRealTerrain) {
  const auto tin = test::big_tujunga(300, 300, 60);
  if (!tin) GTEST_SKIP() << "needs " << test::big_tujunga_path();
  const Box box = tin->bounds();
  expect_exact(*tin, look({box.xmin + 0.47 * box.width(), box.ymin + 0.55 * box.height()}), 0.5);
}

TEST(Horizon, OfACurvedPlaneIsTheSea) {
  const Tin sea = test::lattice_tin(41, 41, 1000, [](std::int32_t, std::int32_t) { return 0.0; });
  const Request request = look({kCorner.x + 20000, kCorner.y + 20000}, 10);
  const Horizon result = run(sea, request, {.step_deg = 10, .targets = {}});
  const double distance = std::sqrt(10 / request.earth.drop_coefficient());
  const double dip = -2 * 10 / distance * kDegrees;
  for (const HorizonPoint& p : result.points) {
    EXPECT_NEAR(p.sky->distance_m, distance, 2);
    EXPECT_NEAR(p.sky->elevation_deg, dip, 1e-4);
    EXPECT_FALSE(p.sky->data_edge);
  }
}

TEST(Horizon, MarksWhereTheDataEnds) {
  // From 100 m up the sea would end 38 km away, but only 20 km of it are known.
  const Tin sea = test::lattice_tin(41, 41, 1000, [](std::int32_t, std::int32_t) { return 0.0; });
  Request request = look({kCorner.x + 20000, kCorner.y + 20000}, 100);
  for (const HorizonPoint& p : run(sea, request, {.step_deg = 10, .targets = {}}).points)
    EXPECT_TRUE(p.sky->data_edge) << p.azimuth_deg;
  // What lies beyond the radius is not asked for.
  request.radius = 15000;
  for (const HorizonPoint& p : run(sea, request, {.step_deg = 10, .targets = {}}).points)
    EXPECT_FALSE(p.sky->data_edge) << p.azimuth_deg;
}

TEST(Horizon, TargetsAreInSightOrNot) {
  const Tin tin = test::fractal_tin(33, 50, 60, 0.55, 7);
  const Request request = look({kCorner.x + 803, kCorner.y + 798}, 25);
  HorizonOptions options;
  for (int i = 0; i < 60; ++i)
    options.targets.push_back(
        {std::to_string(i), {kCorner.x + 27 * i + 3, kCorner.y + 25 * ((i * 37) % 61) + 5}, i % 3 * 5.0});
  const Horizon result = run(tin, request, options);
  const test::ExactLineOfSight exact(tin, request.earth);
  const Point2 o = request.observers[0].position;
  const Point3 eye{o.x, o.y, *exact.height(o) + 25};
  int visible = 0;
  ASSERT_EQ(result.targets.size(), options.targets.size());
  for (const SightedTarget& t : result.targets) {
    const Point2 p = t.target.position;
    EXPECT_NEAR(t.elevation_m, *exact.height(p) + t.target.height, 1e-6);
    const double clearance = exact.clearance(eye, {p.x, p.y, t.elevation_m});
    if (std::abs(clearance) > 2e-6) {
      EXPECT_EQ(t.visible, clearance > 0) << t.target.name;
    }
    visible += t.visible;
    EXPECT_NEAR(std::sin(t.azimuth_deg / kDegrees) * t.distance_m, p.x - o.x, 1e-6);
    EXPECT_NEAR(std::cos(t.azimuth_deg / kDegrees) * t.distance_m, p.y - o.y, 1e-6);
  }
  EXPECT_GT(visible, 5);
  EXPECT_LT(visible, 55);
}

TEST(Horizon, LooksOnlyWhereTheObserverLooks) {
  const Tin tin = test::fractal_tin(33, 50, 60, 0.55, 7);
  Request request = look({kCorner.x + 803, kCorner.y + 798});
  request.azimuth = AngleRange{350, 10};
  const Horizon result = run(tin, request, {.step_deg = 1, .targets = {}});
  ASSERT_EQ(result.points.size(), 21U);
  EXPECT_EQ(result.points.front().azimuth_deg, 350);
  EXPECT_EQ(result.points.back().azimuth_deg, 10);
}

TEST(Horizon, RefusesWhatCannotBe) {
  const Tin tin = test::fractal_tin(17, 50, 60, 0.55, 7);
  const Request request = look({kCorner.x + 403, kCorner.y + 398});
  EXPECT_THROW(run(tin, request, {.step_deg = 0.7, .targets = {}}), InputError);
  EXPECT_THROW(run(tin, request, {.step_deg = 1, .targets = {{"far", {0, 0}, 0}}}), InputError);
  Request two = request;
  two.observers.push_back(two.observers[0]);
  EXPECT_THROW(run(tin, two, {}), InputError);
}

}  // namespace
}  // namespace itin::viewshed
