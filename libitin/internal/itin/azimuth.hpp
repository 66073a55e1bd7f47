// Azimuths: degrees clockwise from grid north, within one turn.
#pragma once

#include <cmath>

#include <itin/degrees.hpp>
#include <itin/geometry.hpp>

namespace itin {

/// Whole turns left out: from 0 to 360, which itself stands for what is below 0 by less than is rounded off.
inline double within_turn(double degrees) {
  const double rest = std::fmod(degrees, 360);
  return rest < 0 ? rest + 360 : std::abs(rest);
}

inline double grid_azimuth_deg(Point2 from, Point2 to) {
  return within_turn(in_degrees(std::atan2(to.x - from.x, to.y - from.y)));
}

}  // namespace itin
