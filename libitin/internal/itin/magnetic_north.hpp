// The direction of a compass needle: the declination after the World Magnetic Model 2025.
//
//   declination_deg({-3.18, 51.48}, 50, 2026.9)     // longitude, latitude, height, decimal year
//
// Source: A. Chulliat et al., "The US/UK World Magnetic Model for 2020-2025: Technical Report", NOAA/NCEI 2020, section
// 1.2 (every edition has these equations); coefficients in geometry/wmm2025.hpp. The model has the slow field of the
// Earth's core alone. Iron, rocks and magnetic storms also turn a needle, by some tenths of a degree in most places.
#pragma once

#include <optional>
#include <string>

#include <itin/calendar_day.hpp>
#include <itin/geometry.hpp>

namespace itin {

inline constexpr const char* kMagneticModel = "WMM2025";
/// The years for which the model is valid: from the first day of 2025 until the last day before 2030.
inline constexpr double kMagneticFrom = 2025, kMagneticUntil = 2030;

struct MagneticField {
  double north_nt = 0, east_nt = 0, down_nt = 0;  ///< towards true north, east and the centre of the ellipsoid
};

/// Returns the field at longitude and latitude in degrees on WGS 84, `height_m` over the ellipsoid, in a decimal year
/// (2026.5 is the middle of 2026). Heights over the sea will do: 100 m change the declination by less than 0.001
/// degrees away from the poles. Not limited to the years for which the model is valid.
MagneticField magnetic_field(Point2 lon_lat, double height_m, double year);

/// Returns the degrees by which magnetic north lies east of true north; negative to the west. Nothing outside the
/// model's years, and where the horizontal field is below 2000 nT: about the magnetic poles a compass shows no
/// direction.
std::optional<double> declination_deg(Point2 lon_lat, double height_m, double year);

/// Tells whether the model is valid on that day.
bool has_declination(const CalendarDay& day);

/// Returns "World Magnetic Model WMM2025 (NOAA/NCEI and BGS), epoch 2025.0, valid from 2025.0 to 2030.0".
std::string magnetic_model_text();

}  // namespace itin
