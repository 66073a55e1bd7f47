// The point of reflection worked by hand, and against a search along the line.
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <profile/diffraction.hpp>

#include "lines/paths/path_cover.hpp"
#include "published_profile.hpp"
#include "support/seed.hpp"

namespace itin::profile {

namespace {

constexpr double kFlatEarth = std::numeric_limits<double>::infinity();

RadioPath earth_of_km(double effective_earth_km) {
  return {.frequency_ghz = 6, .effective_earth_km = effective_earth_km};
}

/// Level ground at a height.
Profile level(double length_m, double height_m) {
  Profile profile;
  profile.length_m = length_m;
  profile.points = {{0, 0, 0, height_m}, {length_m, length_m, 0, height_m}};
  return profile;
}

/// With a wall on it, as a theme that stands there.
Profile with_wall(const Profile& ground, double distance_m, double height_m) {
  Profile profile = ground;
  const double foot = ground.points.front().ground_m;
  profile.points = {ground.points.front()};
  for (const double up : {0.0, height_m, height_m, 0.0}) {
    const double d = distance_m + (profile.points.size() > 2 ? 1 : 0);
    profile.points.push_back({d, d, 0, foot + up, 0, static_cast<std::uint16_t>(up > 0 ? 3 : 0)});
  }
  profile.points.push_back(ground.points.back());
  return profile;
}

TEST(Reflection, OnAFlatEarthDividesThePathAsTheHeights) {
  const auto found = reflection(level(8000, 100), {110, 130}, earth_of_km(kFlatEarth));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distance_m, 2000, 1e-9);
  EXPECT_NEAR(found->grazing_deg, std::atan(10.0 / 2000) * 180 / M_PI, 1e-12);
  EXPECT_NEAR(found->longer_by_m, std::hypot(8000, 40) - std::hypot(8000, 20), 1e-5);
  EXPECT_EQ(found->ground_m, 100);
  EXPECT_FALSE(found->screen);
}

TEST(Reflection, OfEqualHeightsIsInTheMiddleAndGrazesTheBulgingEarth) {
  // At 10 km of 20 the surface has fallen by 10000^2 / (2 * 8500000) = 5.882 m below the plane that touches it there.
  const auto found = reflection(level(20000, 0), {30, 30}, earth_of_km(8500));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distance_m, 10000, 1e-6);
  EXPECT_NEAR(found->grazing_deg, std::atan((30 - 5.88235294) / 10000) * 180 / M_PI, 1e-9);
  EXPECT_FALSE(reflection(level(20000, 0), {5.8, 5.8}, earth_of_km(8500))) << "below each other's horizon";
  EXPECT_FALSE(reflection(level(20000, 10), {9, 30}, earth_of_km(8500))) << "below the ground";
}

/// The place within sight of both antennas where their angles over the bulging ground are equal, by halving.
double searched(double length_m, double from_m, double to_m, double radius_m) {
  const auto excess = [&](double d) {
    const double rest = length_m - d;
    return (from_m - d * d / (2 * radius_m)) / d - (to_m - rest * rest / (2 * radius_m)) / rest;
  };
  double low = 1e-6 * length_m, high = length_m - low;
  for (int i = 0; i < 200; ++i) (excess((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
  return low;
}

TEST(Reflection, IsWhereTheAnglesAreEqual) {
  std::mt19937 random(test::seed());
  std::uniform_real_distribution<double> any_length(500, 60000), any_height(5, 400), any_radius(3000, 9000);
  int seen = 0;
  for (int i = 0; i < 500; ++i) {
    const double length = any_length(random), a = any_height(random), b = any_height(random);
    const double radius = any_radius(random);
    const auto found = reflection(level(length, 50), {50 + a, 50 + b}, earth_of_km(radius));
    const double at = searched(length, a, b, radius * 1000);
    if (!found) {
      EXPECT_LT(a - at * at / (2000 * radius), 1e-6) << "they see each other over the ground";
      continue;
    }
    ++seen;
    EXPECT_NEAR(found->distance_m, at, 1e-6 * length) << length << " " << a << " " << b << " " << radius;
    EXPECT_FALSE(found->screen);
  }
  EXPECT_GT(seen, 250);
}

TEST(Reflection, IsScreenedByWhatStandsInItsWay) {
  const Profile ground = level(4000, 20);
  // To the middle the path falls from 10 m to nothing: at 1001 m, behind the wall's top, it is 4.995 m high.
  const Profile walled = with_wall(ground, 1000, 8);
  const auto found = reflection(walled, {30, 30}, earth_of_km(kFlatEarth), &ground);
  ASSERT_TRUE(found && found->screen);
  EXPECT_NEAR(found->distance_m, 2000, 1e-9);
  EXPECT_NEAR(found->screen_depth_m, 8 - 4.995, 1e-9);
  EXPECT_NEAR(found->screen->distance_m, 1001, 1e-9);
  EXPECT_EQ(found->screen->theme, 3);

  const auto beyond = reflection(reversed(walled), {30, 30}, earth_of_km(kFlatEarth), &ground);
  ASSERT_TRUE(beyond && beyond->screen);
  EXPECT_NEAR(beyond->screen->distance_m, 2999, 1e-9);
  EXPECT_NEAR(beyond->screen_depth_m, found->screen_depth_m, 1e-9);
  EXPECT_FALSE(reflection(with_wall(ground, 1000, 4.99), {30, 30}, earth_of_km(kFlatEarth), &ground)->screen);
}

TEST(Reflection, IsScreenedWhereItsPlaceHidesTheDirectPath) {
  const Profile ground = level(4000, 20);
  const auto hidden = reflection(with_wall(ground, 1999.5, 12.5), {30, 30}, earth_of_km(kFlatEarth), &ground);
  ASSERT_TRUE(hidden && hidden->screen);
  EXPECT_NEAR(hidden->distance_m, 2000, 1e-9);
  EXPECT_NEAR(hidden->screen->distance_m, 2000, 1e-9);
  EXPECT_NEAR(hidden->screen_depth_m, 2.5, 1e-9) << "above the direct path, at 30 m";
  const auto seen = reflection(with_wall(ground, 1999.5, 9.5), {30, 30}, earth_of_km(kFlatEarth), &ground);
  ASSERT_TRUE(seen);
  EXPECT_FALSE(seen->screen) << "the path is reflected by the wall's top";
  // Over the effective Earth the ground rises by 2000^2 / (2 * 8500000) = 0.235 m in the middle.
  const auto grazed = reflection(with_wall(ground, 1999.5, 9.9), {30, 30}, earth_of_km(8500), &ground);
  ASSERT_TRUE(grazed && grazed->screen);
  EXPECT_NEAR(grazed->screen_depth_m, 9.9 + 2000.0 * 2000 / 17e6 - 10, 1e-6);
}

TEST(Reflection, IsUnknownWithoutData) {
  Profile profile = level(4000, 20);
  profile.points.insert(profile.points.begin() + 1, {{1500, 1500, 0, 20}, {2500, 2500, 0, 20}});
  profile.gaps = {{1500, 2500}};
  const auto found = reflection(profile, {30, 30}, earth_of_km(kFlatEarth));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distance_m, 2000, 1e-9);
  EXPECT_FALSE(found->ground_m);
  EXPECT_FALSE(found->screen);
}

TEST(PathCover, AddsUpToTheKnownLength) {
  Profile profile = with_wall(level(4000, 20), 1000, 8);
  profile.points.insert(profile.points.end() - 1, {{3000, 3000, 0, 20}, {3250, 3250, 0, 20}});
  profile.gaps = {{3000, 3250}};
  const std::vector<ThemeLength> cover = path_cover(profile);
  ASSERT_EQ(cover.size(), 2U);
  EXPECT_EQ(cover[0].theme, 0);
  EXPECT_EQ(cover[1].theme, 3);
  EXPECT_EQ(cover[1].length_m, 1);
  EXPECT_EQ(cover[0].length_m + cover[1].length_m, 3750);
}

TEST(Edges, AreThoseOfTheLosses) {
  const Profile path = test::published_profile("sg3_path2");
  const Antennas antennas{path.points.front().ground_m + 30, path.points.back().ground_m + 30};
  const PathLosses losses = path_losses(path, antennas, earth_of_km(8500));
  ASSERT_TRUE(losses.bullington);
  const double single = losses.bullington->loss_db, d = path.length_m / 1000;
  EXPECT_EQ(single, knife_edge_loss_db(losses.bullington->v));
  EXPECT_NEAR(losses.lba_db, single + (1 - std::exp(-single / 6)) * (10 + 0.02 * d), 1e-12);

  ASSERT_EQ(losses.deygout.size(), 3U);
  EXPECT_EQ(losses.deygout[0].loss_db, losses.knife_edge_db);
  EXPECT_EQ(losses.deygout[0].v, losses.largest_v);
  EXPECT_LT(losses.deygout[1].distance_m, losses.deygout[0].distance_m);
  EXPECT_GT(losses.deygout[2].distance_m, losses.deygout[0].distance_m);
  const double others = losses.deygout[1].loss_db + losses.deygout[2].loss_db + 10 + 0.04 * d;
  EXPECT_NEAR(losses.deygout_db, losses.deygout[0].loss_db + (1 - std::exp(-losses.deygout[0].loss_db / 6)) * others,
              1e-12);
}

TEST(Edges, OfOneHillAreItsTop) {
  Profile hill = level(10000, 0);
  hill.points.insert(hill.points.begin() + 1, {4000, 4000, 0, 80});
  const PathLosses losses = path_losses(hill, {50, 50}, earth_of_km(kFlatEarth));
  ASSERT_TRUE(losses.bullington);
  EXPECT_NEAR(losses.bullington->distance_m, 4000, 1e-9);
  EXPECT_NEAR(losses.bullington->elevation_m, 80, 1e-9);
  ASSERT_EQ(losses.deygout.size(), 1U);
  EXPECT_EQ(losses.deygout[0].distance_m, 4000);
  EXPECT_EQ(losses.deygout[0].elevation_m, 80);
}

TEST(Edges, OfAFreePathAreNone) {
  const PathLosses losses = path_losses(test::even_profile(2500, {0, 0, 0, 0, 0}), {200, 200}, earth_of_km(8500));
  EXPECT_FALSE(losses.bullington);
  EXPECT_TRUE(losses.deygout.empty());
}

}  // namespace

}  // namespace itin::profile
