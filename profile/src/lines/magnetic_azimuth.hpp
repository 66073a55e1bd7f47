// Directions from magnetic north.
#pragma once

#include <chrono>
#include <optional>

#include <itin/azimuth.hpp>
#include <itin/geometry.hpp>
#include <itin/magnetic_north.hpp>

namespace itin::profile {

/// The declination of magnetic north at longitude and latitude; nothing without a day, and where declination_deg() has
/// nothing.
inline std::optional<double> declination_on(const std::optional<std::chrono::year_month_day>& day, Point2 lon_lat,
                                            double elevation_m) {
  return day ? declination_deg(lon_lat, elevation_m, decimal_year(*day)) : std::nullopt;
}

/// The magnetic azimuth for an azimuth clockwise from true north.
inline std::optional<double> magnetic_azimuth_deg(double azimuth_true_deg, const std::optional<double>& declination) {
  return declination ? std::optional(within_turn(azimuth_true_deg - *declination)) : std::nullopt;
}

}  // namespace itin::profile
