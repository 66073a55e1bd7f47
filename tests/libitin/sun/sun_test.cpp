// Where the sun stands: published values, and another published algorithm.
#include <chrono>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itin/azimuth.hpp>
#include <itin/degrees.hpp>
#include <itin/sun.hpp>

#include "support/seed.hpp"

namespace itin {
namespace {

using namespace std::chrono_literals;

double azimuth_deg(const Point3& local) {
  return within_turn(in_degrees(std::atan2(local.x, local.y)));
}
double elevation_deg(const Point3& local) {
  return in_degrees(std::asin(local.z));
}
double angle_deg(const Point3& a, const Point3& b) {
  return in_degrees(2 * std::asin(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) / 2));
}

// Meeus, examples 25.a (declination) and 28.b (equation of time): 1992 October 13, 0h terrestrial time.
TEST(Sun, StandsWhereMeeusSays) {
  const double ut = 2448908.5 - 69.0 / 86400;
  const Point3 sun = sun_direction(ut);
  EXPECT_NEAR(in_degrees(std::asin(sun.z)), -7.78507, 1e-4);
  const double equation_of_time = 3.427351, turned = -69.0 / 86400 * 360;
  EXPECT_NEAR(in_degrees(std::atan2(sun.y, sun.x)), 180 - turned - equation_of_time, 0.005);
}

// NREL/TP-560-34302, appendix A.5.
TEST(Sun, StandsWhereSpaSays) {
  const auto moment = std::chrono::sys_days{std::chrono::year{2003} / 10 / 17} + 19h + 30min + 30s;
  const SkyAt sky({-105.1786, 39.742476}, 1830.14);
  const Point3 seen = sky.apparent(sun_direction(julian_day(moment)));
  EXPECT_NEAR(90 - elevation_deg(seen), 50.11162, 0.01);
  EXPECT_NEAR(azimuth_deg(seen), 194.34024, 0.01);
}

// The same source: the sun's centre is 0.8333 degrees below the horizon at 06:12:43 and 17:20:19 on the day in
// universal time, which ends there in the afternoon: the sunset is that of the day before.
TEST(Sun, RisesAndSetsWhenSpaSays) {
  const auto midnight = std::chrono::sys_days{std::chrono::year{2003} / 10 / 17} + 7h;
  const SkyAt sky({-105.1786, 39.742476}, 1830.14);
  for (const auto time : {6h + 12min + 43s, 17h + 20min + 19s - 24h})
    EXPECT_NEAR(elevation_deg(sky.local(sun_direction(julian_day(midnight + time)))), -0.8333, 0.01);
}

// The Astronomical Almanac, page C24: another series, good to 0.01 degrees from 1950 to 2050.
TEST(Sun, StandsWhereTheAlmanacsSeriesSays) {
  std::mt19937 random(test::seed());
  std::uniform_real_distribution<double> days(2433282.5, 2469807.5);
  for (int i = 0; i < 2000; ++i) {
    const double day = days(random), n = day - 2451545.0;
    const double g = in_radians(357.528 + 0.9856003 * n);
    const double longitude = in_radians(280.460 + 0.9856474 * n + 1.915 * std::sin(g) + 0.020 * std::sin(2 * g));
    const double tilt = in_radians(23.439 - 0.0000004 * n);
    const double ascension = std::atan2(std::cos(tilt) * std::sin(longitude), std::cos(longitude));
    const double declination = std::asin(std::sin(tilt) * std::sin(longitude));
    const double greenwich = in_radians(15 * std::fmod(18.697374558 + 24.06570982441908 * n, 24));
    const double east = ascension - greenwich;
    const Point3 other{std::cos(declination) * std::cos(east), std::cos(declination) * std::sin(east),
                       std::sin(declination)};
    EXPECT_LT(angle_deg(sun_direction(day), other), 0.02) << day;
  }
}

TEST(Sun, IsLiftedByTheAir) {
  // Meeus, example 16.a: what truly stands at 33'20.2" is seen 24.618' higher, at 57'57.3", at sea level.
  EXPECT_NEAR(refraction_deg(33.337 / 60, 0), 24.618 / 60, 0.003);
  EXPECT_NEAR(refraction_deg(90, 0), 0, 1e-4);
  EXPECT_EQ(refraction_deg(-2, 0), 0);
  EXPECT_LT(refraction_deg(3, 2000), refraction_deg(3, 0));
}

TEST(Sun, IsSeenFromThePoleAllSummer) {
  const SkyAt pole({0, 90}, 0);
  const auto solstice = std::chrono::sys_days{std::chrono::year{2026} / 6 / 21};
  for (const auto hour : {0h, 6h, 12h, 18h})
    EXPECT_NEAR(elevation_deg(pole.apparent(sun_direction(julian_day(solstice + hour)))), 23.45, 0.06);
}

TEST(Sun, LocalAxesTurnBack) {
  const SkyAt sky({12.5, -33.1}, 10);
  const Point3 there{0.36, 0.48, 0.8};
  EXPECT_LT(angle_deg(sky.of_earth(sky.local(there)), there), 1e-6);
}

}  // namespace
}  // namespace itin
