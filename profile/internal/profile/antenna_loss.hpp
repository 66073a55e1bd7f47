// What an antenna loses in a direction off its axis.
//
//   const AntennaPattern pattern = read_antenna_pattern("sector.msi");
//   const double lost_db = off_axis_db(pattern, {.azimuth_deg = 30, .elevation_deg = -2}, 4);
#pragma once

#include <profile/diffraction.hpp>

namespace itin::profile {

/// The ranges, degrees, in which the axis of an antenna may be given.
inline constexpr double kLeastAzimuth = -180, kMostAzimuth = 360, kMostTilt = 90;

/// Whether an azimuth from grid north, or a tilt below the horizontal, is in its range.
inline bool is_azimuth(double degrees) {
  return degrees >= kLeastAzimuth && degrees <= kMostAzimuth;
}
inline bool is_tilt(double degrees) {
  return degrees >= -kMostTilt && degrees <= kMostTilt;
}

/// A direction from an antenna: clockwise from the azimuth of its axis, and above the horizontal.
struct AntennaDirection {
  double azimuth_deg = 0, elevation_deg = 0;
};

/// Returns what an antenna has less than its gain in a direction, where its axis is tilted down by `tilt_deg`. The two
/// cuts are added, as is usual: H(a) - H(0) + V(e), and at most the greatest loss of either. H(0) counts once because
/// horizontal cuts of tilted beams are often those of the horizon.
double off_axis_db(const AntennaPattern& pattern, const AntennaDirection& direction, double tilt_deg);

}  // namespace itin::profile
