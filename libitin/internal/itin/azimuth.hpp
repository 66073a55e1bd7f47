// Azimuths: degrees clockwise from grid north, within one turn.
#pragma once

#include <cmath>

#include <itin/degrees.hpp>
#include <itin/geometry.hpp>

namespace itin {

/// Leaves out whole turns. Returns 0 to 360; 360 itself only for angles below 0 by less than the rounding.
inline double within_turn(double degrees) {
  const double rest = std::fmod(degrees, 360);
  return rest < 0 ? rest + 360 : std::abs(rest);
}

inline double grid_azimuth_deg(Point2 from, Point2 to) {
  return within_turn(in_degrees(std::atan2(to.x - from.x, to.y - from.y)));
}

}  // namespace itin
