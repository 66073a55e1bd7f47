// Directions and distances on the ellipsoid WGS84.
//
//   geodesic({-4.0763, 53.0685}, {-3.5, 52.7}).azimuth_deg     // from true north, clockwise
#pragma once

#include <itin/geometry.hpp>

namespace itin {

struct Geodesic {
  double distance_m = 0;
  double azimuth_deg = 0;       ///< at the first point, towards the second, in [0, 360); 0 where they coincide
  double back_azimuth_deg = 0;  ///< at the second point, towards the first
};

/// Between two points given as longitude, latitude in degrees. Method: T. Vincenty, Survey Review 23 (1975), 88-93;
/// good to a millimetre and 1e-6 degrees wherever sight lines exist. It does not converge for nearly antipodal points,
/// for which an InputError is thrown.
Geodesic geodesic(Point2 from, Point2 to);

}  // namespace itin
