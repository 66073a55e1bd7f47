// Directions from grid north and from magnetic north.
#pragma once

#include <chrono>
#include <cmath>
#include <optional>

#include <itin/geodesic.hpp>
#include <itin/geometry.hpp>
#include <itin/magnetic_north.hpp>

namespace itin::profile {

/// Clockwise from grid north, in [0, 360).
inline double grid_azimuth_deg(Point2 from, Point2 to) {
  const double azimuth = std::atan2(to.x - from.x, to.y - from.y) * kDegreesPerRadian;
  return azimuth < 0 ? azimuth + 360 : azimuth;
}

/// Magnetic north's at longitude and latitude; nothing without a day, and where declination_deg() has nothing.
inline std::optional<double> declination_on(const std::optional<std::chrono::year_month_day>& day, Point2 lon_lat,
                                            double elevation_m) {
  return day ? declination_deg(lon_lat, elevation_m, decimal_year(*day)) : std::nullopt;
}

/// From an azimuth clockwise from true north; in [0, 360).
inline std::optional<double> magnetic_azimuth_deg(double azimuth_true_deg, const std::optional<double>& declination) {
  if (!declination) return std::nullopt;
  const double azimuth = std::fmod(azimuth_true_deg - *declination, 360);
  return azimuth < 0 ? azimuth + 360 : azimuth;
}

}  // namespace itin::profile
