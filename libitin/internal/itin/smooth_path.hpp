// A path over a smooth Earth.
#pragma once

namespace itin {

/// Antennas over a smooth surface; at least one of them is above it.
struct SmoothPath {
  double distance_km = 0;
  double from_m = 0, to_m = 0;  ///< heights above the surface
};

/// Returns how far from the first antenna, km, the surface of an Earth of this effective radius is met under the same
/// angle from both: P.452-17 section 4.2.2.1, equations (25b) to (25e) (P.526-15 section 3.2.1). Precondition: the
/// antennas see each other over the surface.
double reflection_km(const SmoothPath& path, double effective_earth_km);

}  // namespace itin
