// What an antenna loses in a direction off its axis.
//
//   const AntennaPattern pattern = read_antenna_pattern("sector.msi");
//   const double lost_db = off_axis_db(pattern, {.azimuth_deg = 30, .elevation_deg = -2}, 4);
#pragma once

#include <profile/diffraction.hpp>

namespace itin::profile {

/// A direction from an antenna: clockwise from the azimuth of its axis, and above the horizontal.
struct AntennaDirection {
  double azimuth_deg = 0, elevation_deg = 0;
};

/// Returns what an antenna has less than its gain in a direction, where its axis is tilted down by `tilt_deg`. The two
/// cuts are added, as is usual: H(a) - H(0) + V(e), and at most the greatest loss of either. H(0) counts once because
/// horizontal cuts of tilted beams are often those of the horizon.
double off_axis_db(const AntennaPattern& pattern, const AntennaDirection& direction, double tilt_deg);

}  // namespace itin::profile
