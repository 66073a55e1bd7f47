// Wirelines as drawn: crests that go on from one distance band into the next, and turned blades.
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include <itin/cross_section.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <profile/wireline.hpp>

#include "sheet/wireline_strip.hpp"
#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"

namespace itin::profile {
namespace {

/// Two bands; the nearer one's crest ends after half of the lines of sight. The farther one's begins at this line.
Wireline passing(std::size_t begin) {
  Wireline view;
  view.query.width_deg = 10, view.query.step_deg = 0.5;
  constexpr std::size_t kLines = 21, kHalf = 10;
  WirelineBand near{0, 5000, {}, {}}, far{5000, 40000, {}, {}};
  for (std::size_t i = 0; i < kLines; ++i) {
    const bool in_near = i < kHalf;
    near.angle_deg.push_back(in_near ? 1 : std::numeric_limits<float>::quiet_NaN()), near.crest.push_back(in_near);
    far.angle_deg.push_back(0.9F), far.crest.push_back(i >= begin);
  }
  view.bands = {near, far};
  return view;
}

std::size_t paths_of(const std::string& svg) {
  std::size_t count = 0;
  for (std::size_t at = svg.find("<path"); at != std::string::npos; at = svg.find("<path", at + 1)) ++count;
  return count;
}

TEST(Wirelines, JoinACrestThatGoesOnInTheNextBand) {
  const std::size_t without = paths_of(draw_wireline(passing(9), "w.svg"));  // two crests that overlap
  EXPECT_EQ(paths_of(draw_wireline(passing(10), "w.svg")), without + 1);
  EXPECT_EQ(paths_of(draw_wireline(passing(11), "w.svg")), without);  // another crest
}

TEST(Wirelines, DrawAMeshWhereTheGroundRisesFromBandToBand) {
  Wireline view = passing(10);
  view.query.from_deg = 0;
  const std::size_t without = paths_of(draw_wireline(view, "w.svg"));
  // Beyond the near band the ground rises in four lines of sight, two of which are on whole degrees.
  for (const std::size_t line : {4, 5, 6, 7}) view.bands[1].angle_deg[line] = 1.2F;
  EXPECT_EQ(paths_of(draw_wireline(view, "w.svg")), without + 2);
}

TEST(Wirelines, DrawBladesAsTheyAreTurned) {
  Wireline view = passing(10);
  view.query.eye_elevation_m = 0;
  view.query.turbines = {{"1", {50, 2000}, 100, 80, 130, true, "", 0}};
  const std::string upright = draw_wireline(view, "w.svg");
  view.query.turbines[0].blade_deg = 30;
  EXPECT_NE(upright, draw_wireline(view, "w.svg"));
}

/// Ground on which the skyline stands at one elevation to the left, and at another to the right.
Wireline skyline(double left_deg, double right_deg) {
  Wireline view;
  view.query.width_deg = 90, view.query.step_deg = 0.5, view.query.reach_m = 40000;
  WirelineBand band{0, 5000, {}, {}};
  for (int i = 0; i <= 180; ++i)
    band.angle_deg.push_back(static_cast<float>(i <= 90 ? left_deg : right_deg)), band.crest.push_back(true);
  view.bands = {band};
  return view;
}

TEST(Wirelines, ShiftTheirFrameToTheSkyline) {
  constexpr double kPoints = 72 / 25.4, kHeight = 260 * kPoints, kPrincipal = 812.5;
  const WirelineStrip strip{StripProjection::kCylindrical, {0, 0, 820 * kPoints, kHeight}, kPrincipal, 45, 53.5};
  const auto height_of = [&](double elevation_deg) {
    return kPrincipal * kPoints * std::tan(elevation_deg * std::numbers::pi / 180);
  };
  EXPECT_EQ(horizon_shift(skyline(0, 0), strip), 0);
  // A hillside fills the view: its skyline stands in the upper part of the frame.
  for (const double hill : {10.0, 14.0, 18.0}) {
    const double above_middle = height_of(hill) - horizon_shift(skyline(hill, hill), strip);
    EXPECT_LT(above_middle, kHeight / 2) << hill;
    EXPECT_GT(above_middle, 0) << hill;
  }
  // A turbine stands hidden behind a hill beside the middle: the frame has the skyline above it.
  Wireline view = skyline(0, 12);
  EXPECT_EQ(horizon_shift(view, strip), 0);
  const double azimuth = 60 * std::numbers::pi / 180;
  view.query.turbines = {{"1", {5000 * std::sin(azimuth), 5000 * std::cos(azimuth)}, 0, 80, 130, false, "", 0}};
  EXPECT_LT(height_of(12) - horizon_shift(view, strip), kHeight / 2);
  // A wall in the middle moves no tip out of the frame.
  Wireline wall = skyline(60, 0);
  wall.query.turbines = view.query.turbines;
  const double tip = height_of(std::atan2(130, 5000) * 180 / std::numbers::pi);
  EXPECT_GT(tip - horizon_shift(wall, strip), -kHeight / 2);
}

TEST(Wirelines, BeginAtTheFeetOfTheEye) {
  const test::TemporaryDirectory directory;
  test::write_raster(directory.file("t.tif"), {300000, 200000, 10, 60, 60, 27700}, [](int, int) { return 100.0; });
  NoProgress progress;
  ImportOptions options;
  options.sources = {directory.file("t.tif")};
  import_terrain(directory.file("s.itin"), options, progress);
  const Store store(directory.file("s.itin"));
  const SectionSurface surface(store, Detail::tolerance(0), ThemeChoice::none());
  WirelineQuery query;
  query.eye = {300250, 199750}, query.eye_elevation_m = 102;
  query.width_deg = 90, query.step_deg = 5, query.reach_m = 200;
  const Wireline view = survey_wireline(surface, query, progress);
  // Level ground is seen under the angle of the band's far end.
  for (const WirelineBand& band : view.bands)
    for (const float angle : band.angle_deg)
      EXPECT_NEAR(angle, std::atan2(-2, band.to_m) * 180 / std::numbers::pi, 0.01) << band.to_m;
  EXPECT_LT(view.bands.front().angle_deg.front(), -30);
}

}  // namespace
}  // namespace itin::profile
