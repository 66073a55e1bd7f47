#include <algorithm>
#include <cmath>

#include <itin/degrees.hpp>
#include <itin/sun.hpp>

namespace itin {

namespace {

constexpr double kDaysPerCentury = 36525, kEpochJ2000 = 2451545;
/// Terrestrial less universal time, days: 69 s. A minute more or less moves the sun by a thousandth of a degree.
constexpr double kDeltaT = 69.0 / 86400;
/// The angle of the Earth's radius at the sun.
constexpr double kParallaxDeg = 8.794 / 3600;

double sine_of_degrees(double degrees) {
  return std::sin(in_radians(degrees));
}
double cosine_of_degrees(double degrees) {
  return std::cos(in_radians(degrees));
}

/// The sun's apparent place on the ecliptic, and the ecliptic's; degrees.
struct Ecliptic {
  double longitude, obliquity;
  double nutation;  ///< part of the longitude
};

Ecliptic ecliptic_of_sun(double centuries) {
  const double t = centuries;
  const double mean = 280.46646 + t * (36000.76983 + t * 0.0003032);
  const double anomaly = 357.52911 + t * (35999.05029 - t * 0.0001537);
  const double centre = (1.914602 - t * (0.004817 + t * 0.000014)) * sine_of_degrees(anomaly) +
                        (0.019993 - t * 0.000101) * sine_of_degrees(2 * anomaly) +
                        0.000289 * sine_of_degrees(3 * anomaly);
  const double node = 125.04 - 1934.136 * t;
  const double nutation = -0.00478 * sine_of_degrees(node);
  const double obliquity = 23 + (26 + (21.448 - t * (46.815 + t * (0.00059 - t * 0.001813))) / 60) / 60;
  return {mean + centre - 0.00569 + nutation, obliquity + 0.00256 * cosine_of_degrees(node), nutation};
}

/// The hour angle of the vernal equinox at longitude 0, degrees.
double sidereal_time_deg(double julian_day, const Ecliptic& ecliptic) {
  const double days = julian_day - kEpochJ2000, t = days / kDaysPerCentury;
  return 280.46061837 + 360.98564736629 * days + t * t * (0.000387933 - t / 38710000) +
         ecliptic.nutation * cosine_of_degrees(ecliptic.obliquity);
}

double dot(const Point3& a, const Point3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// The usual pressure of the air at a height, in units of 1010 hPa.
double pressure_at(double height_m) {
  return std::pow(std::max(0.0, 1 - 2.25577e-5 * height_m), 5.25588) * 1013.25 / 1010;
}

/// The refraction, degrees, under such a pressure.
double refraction_under(double pressure, double true_elevation_deg) {
  constexpr double kLowest = -1;
  if (true_elevation_deg < kLowest) return 0;
  const double minutes = 1.02 / std::tan(in_radians(true_elevation_deg + 10.3 / (true_elevation_deg + 5.11)));
  return std::max(0.0, pressure * minutes / 60);
}

}  // namespace

double julian_day(std::chrono::sys_seconds moment) {
  constexpr double kUnixEpoch = 2440587.5;
  return kUnixEpoch + static_cast<double>(moment.time_since_epoch().count()) / 86400;
}

Point3 sun_direction(double julian_day) {
  const Ecliptic sun = ecliptic_of_sun((julian_day + kDeltaT - kEpochJ2000) / kDaysPerCentury);
  const double x = cosine_of_degrees(sun.longitude), along = sine_of_degrees(sun.longitude);
  const double y = along * cosine_of_degrees(sun.obliquity), z = along * sine_of_degrees(sun.obliquity);
  const double turn = in_radians(sidereal_time_deg(julian_day, sun));
  const double sine = std::sin(turn), cosine = std::cos(turn);
  return {x * cosine + y * sine, y * cosine - x * sine, z};
}

double refraction_deg(double true_elevation_deg, double height_m) {
  return refraction_under(pressure_at(height_m), true_elevation_deg);
}

SkyAt::SkyAt(Point2 lon_lat, double height_m) : pressure_(pressure_at(height_m)) {
  const double sine_lon = sine_of_degrees(lon_lat.x), cosine_lon = cosine_of_degrees(lon_lat.x);
  const double sine_lat = sine_of_degrees(lon_lat.y), cosine_lat = cosine_of_degrees(lon_lat.y);
  east_ = {-sine_lon, cosine_lon, 0};
  north_ = {-sine_lat * cosine_lon, -sine_lat * sine_lon, cosine_lat};
  up_ = {cosine_lat * cosine_lon, cosine_lat * sine_lon, sine_lat};
}

Point3 SkyAt::local(const Point3& direction) const {
  return {dot(direction, east_), dot(direction, north_), dot(direction, up_)};
}

Point3 SkyAt::of_earth(const Point3& local) const {
  return {local.x * east_.x + local.y * north_.x + local.z * up_.x,
          local.x * east_.y + local.y * north_.y + local.z * up_.y,
          local.x * east_.z + local.y * north_.z + local.z * up_.z};
}

Point3 SkyAt::apparent(const Point3& sun) const {
  const Point3 place = local(sun);
  const double level = std::hypot(place.x, place.y);
  const double seen_from_here = in_degrees(std::atan2(place.z, level)) - kParallaxDeg * level;
  const double elevation = in_radians(seen_from_here + refraction_under(pressure_, seen_from_here));
  if (level == 0) return {0, 0, place.z};
  const double scale = std::cos(elevation) / level;
  return {place.x * scale, place.y * scale, std::sin(elevation)};
}

}  // namespace itin
