// Wirelines as drawn: crests that go on from one distance band into the next, and turned blades.
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include <profile/wireline.hpp>

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

}  // namespace
}  // namespace itin::profile
