// The horizon of an observer, against exact lines of sight just above and just below it in every direction.
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/horizon.hpp>

#include "support/exact_line_of_sight.hpp"
#include "support/hills_and_town.hpp"
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
      EXPECT_EQ(t.verdict == Verdict::kVisible, clearance > 0) << t.target.name;
    }
    visible += t.verdict == Verdict::kVisible;
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

void expect_same_horizon(const Horizon& expected, const Horizon& found) {
  EXPECT_EQ(expected.eye_elevation_m, found.eye_elevation_m);
  ASSERT_EQ(expected.points.size(), found.points.size());
  for (std::size_t i = 0; i < expected.points.size(); ++i) {
    SCOPED_TRACE(expected.points[i].azimuth_deg);
    const auto &e = expected.points[i].sky, &f = found.points[i].sky;
    EXPECT_EQ(expected.points[i].azimuth_deg, found.points[i].azimuth_deg);
    ASSERT_EQ(e.has_value(), f.has_value());
    if (!e) continue;
    EXPECT_EQ(e->elevation_deg, f->elevation_deg);
    EXPECT_EQ(e->distance_m, f->distance_m);
    EXPECT_EQ(e->position, f->position);
    EXPECT_EQ(e->theme, f->theme);
    EXPECT_EQ(e->data_edge, f->data_edge);
  }
  ASSERT_EQ(expected.targets.size(), found.targets.size());
  for (std::size_t i = 0; i < expected.targets.size(); ++i) {
    EXPECT_EQ(expected.targets[i].elevation_m, found.targets[i].elevation_m);
    EXPECT_EQ(expected.targets[i].azimuth_deg, found.targets[i].azimuth_deg);
    EXPECT_EQ(expected.targets[i].verdict, found.targets[i].verdict);
  }
}

Horizon of_the_whole(const Store& store, const Request& request, const HorizonOptions& options) {
  NoProgress progress;
  const Tin surface = triangulate(store, Window::all(), request.detail, progress, request.themes);
  const Tin ground = triangulate(store, Window::all(), request.detail, progress, ThemeChoice::none());
  return horizon(surface, ground, request, options, progress);
}

/// With memory for the whole surface, and for some dozens of wedges of it.
void expect_same_in_wedges(const Store& store, const Request& request, const HorizonOptions& options) {
  NoProgress progress;
  const Horizon whole = of_the_whole(store, request, options);
  for (const std::uint64_t points : {100000, 4000})
    expect_same_horizon(whole, horizon(store, request, options, {.memory_bytes = 480 * points}, progress));
}

/// Off the hole in the hills.
std::vector<HorizonTarget> places_about(Point2 middle, double side) {
  std::vector<HorizonTarget> targets;
  for (int i = 0; i < 40; ++i) {
    const Point2 p{middle.x + side * (i * 37 % 61 - 30) / 60, middle.y + side * (i * 23 % 61 - 30) / 60};
    if (std::hypot(p.x - 301200, p.y - 201600) > 300) targets.push_back({std::to_string(i), p, i % 3 * 4.0});
  }
  return targets;
}

class HorizonInWedges : public testing::Test {
 protected:
  static void SetUpTestSuite() { stores_ = new test::HillsAndTown; }
  static void TearDownTestSuite() {
    delete stores_;
    stores_ = nullptr;
  }
  /// On a post, with lines along rows, columns and diagonals.
  static Request over_hills() {
    Request request = test::HillsAndTown::over_hills();
    request.observers = {{"o", kPost, 5}};
    return request;
  }

  static constexpr Point2 kPost{302010, 202010};
  static inline test::HillsAndTown* stores_ = nullptr;
};

TEST_F(HorizonInWedges, IsThatOfAllHills) {
  const Store hills(stores_->hills());
  Request request = over_hills();
  const HorizonOptions options{.step_deg = 1, .targets = places_about(kPost, 1500)};
  expect_same_in_wedges(hills, request, options);
  request.azimuth = AngleRange{300, 80};
  request.radius = 1800;
  expect_same_in_wedges(hills, request, options);
  request.detail = Detail::tolerance(2);
  expect_same_in_wedges(hills, request, options);
}

TEST_F(HorizonInWedges, IsThatOfTheWholeTown) {
  const Store town(stores_->town());
  Request request = test::HillsAndTown::over_town();
  const Point2 eye{321733.4, 4297655.2};
  request.observers = {{"o", eye, 12}};
  request.radius = 150;
  for (const bool on_surface : {false, true}) {
    request.observers_on_surface = request.targets_on_surface = on_surface;
    expect_same_in_wedges(town, request, {.step_deg = 4, .targets = places_about(eye, 120)});
  }
}

TEST_F(HorizonInWedges, TakesTheSurfaceOfAViewshed) {
  NoProgress progress;
  const Store hills(stores_->hills());
  Request request = over_hills();
  request.cell_size = 200;
  const HorizonOptions options{.step_deg = 10, .targets = {}};
  const Horizon whole = of_the_whole(hills, request, options);
  for (const ComputeOptions& compute : {ComputeOptions{std::uint64_t{1} << 30, true},
                                        {std::uint64_t{1} << 30, false},
                                        {std::uint64_t{4} << 20, true},
                                        {std::uint64_t{4} << 20, false}}) {
    ViewshedWithSurface computed = compute_with_surface(hills, request, compute, progress);
    expect_same_horizon(whole, horizon(hills, computed, request, options, compute, progress));
  }
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
