// The magnetic field against NOAA's published values, and against the gradient of its potential.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itin/degrees.hpp>
#include <itin/geodesic.hpp>
#include <itin/magnetic_north.hpp>

#include "geometry/wmm2025.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

struct Published {
  double year, height_km, latitude, longitude;
  double north_nt, east_nt, down_nt;
  double declination;
};

/// NOAA/NCEI, WMM2025_TEST_VALUES.txt: all twelve; fields to 0.1 nT, declinations to 0.01 degrees.
constexpr Published kPublished[] = {
    {2025.0, 0, 80, 0, 6521.6, 145.9, 54791.5, 1.28},
    {2025.0, 0, 0, 120, 39677.8, -109.6, -10580.2, -0.16},
    {2025.0, 0, -80, 240, 6117.5, 15751.9, -52022.5, 68.78},
    {2025.0, 100, 80, 0, 6216.0, 92.4, 52598.8, 0.85},
    {2025.0, 100, 0, 120, 37688.6, -96.2, -10152.1, -0.15},
    {2025.0, 100, -80, 240, 5907.6, 14780.3, -49540.7, 68.21},
    {2027.5, 0, 80, 0, 6500.8, 294.5, 54869.4, 2.59},
    {2027.5, 0, 0, 120, 39701.6, -167.4, -10381.8, -0.24},
    {2027.5, 0, -80, 240, 6200.7, 15730.3, -51783.7, 68.49},
    {2027.5, 100, 80, 0, 6196.7, 233.8, 52670.5, 2.16},
    {2027.5, 100, 0, 120, 37711.5, -148.7, -9969.8, -0.23},
    {2027.5, 100, -80, 240, 5984.0, 14760.1, -49317.7, 67.93},
    // WMM2025_TestValues.txt of the coefficients' archive has more figures.
    {2025.0, 28, 89, -121, -255.388723, -1482.460628, 56194.288771, -99.77},
    {2025.0, 65, 43, 93, 24299.852822, 210.517066, 50037.923998, 0.50},
    {2025.0, 51, -33, 109, 21737.778822, -2090.274098, -52710.003920, -5.49},
    {2025.5, 6, -36, -137, 23781.930678, 8786.698927, -32577.518648, 20.28},
    {2026.0, 62, -14, 99, 33437.828630, -835.919473, -33100.922253, -1.43},
    {2026.5, 14, 0, 80, 39431.415992, -2133.456168, -12188.838466, -3.10},
    {2027.5, 73, -72, 95, -2912.418045, -12984.118939, -55399.217725, -102.64},
};

TEST(MagneticNorth, AgreesWithThePublishedValues) {
  for (const Published& p : kPublished) {
    SCOPED_TRACE(testing::Message() << p.year << ": " << p.latitude << ", " << p.longitude);
    const MagneticField field = magnetic_field({p.longitude, p.latitude}, p.height_km * 1000, p.year);
    EXPECT_NEAR(field.north_nt, p.north_nt, 0.051);
    EXPECT_NEAR(field.east_nt, p.east_nt, 0.051);
    EXPECT_NEAR(field.down_nt, p.down_nt, 0.051);
    EXPECT_NEAR(in_degrees(std::atan2(field.east_nt, field.north_nt)), p.declination, 0.0051);
  }
}

/// A point as the vectors of a slow twin have it.
struct Cartesian {
  double x, y, z;
};

Cartesian cartesian(double longitude, double latitude, double height_m) {
  const double e2 = kWgs84.flattening * (2 - kWgs84.flattening);
  const double normal = kWgs84.major_m / std::sqrt(1 - e2 * std::pow(std::sin(latitude), 2));
  return {(normal + height_m) * std::cos(latitude) * std::cos(longitude),
          (normal + height_m) * std::cos(latitude) * std::sin(longitude),
          (normal * (1 - e2) + height_m) * std::sin(latitude)};
}

double factorial(int n) {
  return std::tgamma(n + 1.0);
}

/// Schmidt semi-normalised, by the sum of powers that defines it.
double legendre(int n, int m, double x) {
  double sum = 0;
  for (int k = 0; 2 * k <= n - m; ++k)
    sum += (k % 2 == 0 ? 1 : -1) * factorial(2 * n - 2 * k) /
           (factorial(k) * factorial(n - k) * factorial(n - 2 * k - m)) * std::pow(x, n - 2 * k - m);
  const double norm = m == 0 ? 1 : std::sqrt(2 * factorial(n - m) / factorial(n + m));
  return norm * std::pow(1 - x * x, m / 2.0) * sum / std::pow(2, n);
}

/// nT times metres.
double potential(const Cartesian& p, double year) {
  constexpr double kRadius = 6371200;
  const double r = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z), longitude = std::atan2(p.y, p.x);
  double sum = 0;
  for (const GaussCoefficients& c : kWmm2025) {
    const double g = c.g + c.g_rate * (year - 2025), h = c.h + c.h_rate * (year - 2025);
    sum += kRadius * std::pow(kRadius / r, c.n + 1) * (g * std::cos(c.m * longitude) + h * std::sin(c.m * longitude)) *
           legendre(c.n, c.m, p.z / r);
  }
  return sum;
}

/// How the potential falls in a direction, nT.
double fall(const Cartesian& p, const Cartesian& towards, double year) {
  constexpr double kStep = 200;
  const auto at = [&](double d) {
    return potential({p.x + d * towards.x, p.y + d * towards.y, p.z + d * towards.z}, year);
  };
  return (at(-kStep) - at(kStep)) / (2 * kStep);
}

TEST(MagneticNorth, IsTheFallOfItsPotential) {
  std::mt19937 random(test::seed());
  std::uniform_real_distribution<double> any_longitude(-180, 180), any_latitude(-89, 89), any_height(-100, 9000),
      any_year(2025, 2030);
  for (int i = 0; i < 50; ++i) {
    const double longitude = any_longitude(random), latitude = any_latitude(random), height = any_height(random);
    const double year = any_year(random), l = in_radians(longitude), b = in_radians(latitude);
    SCOPED_TRACE(testing::Message() << longitude << ", " << latitude << ", " << height << ", " << year);
    const Cartesian p = cartesian(l, b, height);
    const MagneticField field = magnetic_field({longitude, latitude}, height, year);
    EXPECT_NEAR(field.north_nt, fall(p, {-std::sin(b) * std::cos(l), -std::sin(b) * std::sin(l), std::cos(b)}, year),
                0.01);
    EXPECT_NEAR(field.east_nt, fall(p, {-std::sin(l), std::cos(l), 0}, year), 0.01);
    EXPECT_NEAR(field.down_nt, -fall(p, {std::cos(b) * std::cos(l), std::cos(b) * std::sin(l), std::sin(b)}, year),
                0.01);
  }
}

TEST(MagneticNorth, IsContinuousAtThePoles) {
  for (const double pole : {90.0, -90.0}) {
    const MagneticField at = magnetic_field({30, pole}, 0, 2026), by = magnetic_field({30, pole * (1 - 1e-9)}, 0, 2026);
    EXPECT_NEAR(at.north_nt, by.north_nt, 1e-3);
    EXPECT_NEAR(at.east_nt, by.east_nt, 1e-3);
    EXPECT_NEAR(at.down_nt, by.down_nt, 1e-3);
  }
}

TEST(MagneticNorth, IsUnknownOutsideTheModelsYearsAndAtTheMagneticPole) {
  EXPECT_FALSE(declination_deg({-3, 52}, 0, 2024.99));
  EXPECT_FALSE(declination_deg({-3, 52}, 0, 2030));
  EXPECT_TRUE(declination_deg({-3, 52}, 0, 2029.99));
  EXPECT_FALSE(declination_deg({139.3, 85.76}, 0, 2025)) << "the north dip pole of 2025";
}

TEST(MagneticNorth, HasTheWholeTable) {
  std::size_t i = 0;
  for (int n = 1; n <= kWmmDegree; ++n)
    for (int m = 0; m <= n; ++m, ++i) {
      EXPECT_EQ(kWmm2025[i].n, n);
      EXPECT_EQ(kWmm2025[i].m, m);
    }
  EXPECT_EQ(i, std::size(kWmm2025));
}

TEST(CalendarDay, IsReadAsPeopleWriteIt) {
  const CalendarDay day{std::chrono::year(2026), std::chrono::month(11), std::chrono::day(3)};
  for (const char* text : {"2026-11-03", "2026-11-3", "3 November 2026", "03 nov 2026", " 3  NOVEMBER 2026"})
    EXPECT_EQ(parse_day(text), day) << text;
  for (const char* text : {"", "November 2026", "31 June 2026", "2026-13-01", "3 Novem 2026", "3 November",
                           "0 May 2026", "3rd November 2026", "issue 3 of 2026", "2026-11-03-1"})
    EXPECT_FALSE(parse_day(text)) << text;
  EXPECT_EQ(day_text(day), "3 November 2026");
  EXPECT_EQ(iso_day_text(day), "2026-11-03");
}

TEST(CalendarDay, IsAPartOfItsYear) {
  EXPECT_EQ(decimal_year(*parse_day("1 January 2025")), 2025);
  EXPECT_EQ(decimal_year(*parse_day("2028-07-02")), 2028.5) << "of a leap year";
  EXPECT_NEAR(decimal_year(*parse_day("2025-12-31")), 2025 + 364.0 / 365, 1e-12);
}

}  // namespace
}  // namespace itin
