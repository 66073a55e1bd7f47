// Directions on the grid.
#pragma once

#include <cmath>

#include <itin/geodesic.hpp>
#include <itin/geometry.hpp>

namespace itin::profile {

/// Clockwise from grid north, in [0, 360).
inline double grid_azimuth_deg(Point2 from, Point2 to) {
  const double azimuth = std::atan2(to.x - from.x, to.y - from.y) * kDegreesPerRadian;
  return azimuth < 0 ? azimuth + 360 : azimuth;
}

}  // namespace itin::profile
