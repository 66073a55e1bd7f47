// Directions and distances on an ellipsoid.
//
//   geodesic({-4.0763, 53.0685}, {-3.5, 52.7}).azimuth_deg     // from true north, clockwise
#pragma once

#include <itin/geometry.hpp>

namespace itin {

struct Ellipsoid {
  double major_m = 0;     ///< the equator's radius
  double flattening = 0;  ///< 0: a sphere
};
inline constexpr Ellipsoid kWgs84{6378137, 1 / 298.257223563};

struct Geodesic {
  double distance_m = 0;
  double azimuth_deg = 0;       ///< at the first point, towards the second, in [0, 360); 0 where they coincide
  double back_azimuth_deg = 0;  ///< at the second point, towards the first
};

/// Returns the geodesic between two points given as longitude, latitude in degrees. Method: T. Vincenty, Survey Review
/// 23 (1975), 88-93; good to a millimetre and 1e-6 degrees wherever sight lines exist. It does not converge for nearly
/// antipodal points, for which it throws InputError.
Geodesic geodesic(Point2 from, Point2 to, const Ellipsoid& ellipsoid = kWgs84);

}  // namespace itin
