// Where the sun stands in the sky.
//
//   const SkyAt sky({-3.18, 51.48}, 50);                                  // longitude, latitude, height
//   const Point3 sun = sky.apparent(sun_direction(julian_day(moment)));   // east, north, up
//   const double elevation_deg = in_degrees(std::asin(sun.z));
//
// Source: J. Meeus, Astronomical Algorithms, 2nd edition, 1998: the sun's apparent place by chapter 25 (lower
// accuracy), sidereal time by (12.4), refraction by (16.4). Good to 0.01 degrees from 1950 to 2100, and to some
// hundredths more below 3 degrees of elevation, where refraction changes with the weather.
#pragma once

#include <chrono>

#include <itin/geometry.hpp>

namespace itin {

/// The years for which the positions are as good as that.
inline constexpr int kFirstYearOfSun = 1950, kLastYearOfSun = 2100;

/// Returns the Julian day of a moment, universal time.
double julian_day(std::chrono::sys_seconds moment);

/// Returns the unit vector from the Earth's centre to the sun's, in axes that turn with the Earth: to longitude 0 on
/// the equator, to 90 degrees east on the equator, and to the north pole.
Point3 sun_direction(double julian_day);

/// Returns by how many degrees the air lifts what truly stands at an elevation, for the usual pressure at a height
/// above the sea and 10 degrees Celsius; 0 for what stands more than a degree below the horizon.
double refraction_deg(double true_elevation_deg, double height_m);

/// The sky over a place.
class SkyAt {
 public:
  /// Longitude and latitude are degrees on an ellipsoid of the Earth, the height is metres above the sea.
  SkyAt(Point2 lon_lat, double height_m);

  /// Turns a direction of those axes to true east, true north and up, and back.
  Point3 local(const Point3& direction) const;
  Point3 of_earth(const Point3& local) const;
  /// Returns the unit vector to where the sun is seen: to true east, true north and up. `sun` is a sun_direction().
  /// Minds refraction, and that the eye is not at the Earth's centre.
  Point3 apparent(const Point3& sun) const;

 private:
  double pressure_;  ///< air pressure, in units of 1010 hPa
  Point3 east_, north_, up_;
};

}  // namespace itin
