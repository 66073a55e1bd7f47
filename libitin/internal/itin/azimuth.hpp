// Azimuths: degrees clockwise from grid north, within one turn.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

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

/// Returns the nearest of the sixteen points of the compass: "north-north-west".
inline const char* compass_point(double azimuth_deg) {
  constexpr std::array kPoints{"north", "north-north-east", "north-east", "east-north-east",
                               "east",  "east-south-east",  "south-east", "south-south-east",
                               "south", "south-south-west", "south-west", "west-south-west",
                               "west",  "west-north-west",  "north-west", "north-north-west"};
  const auto points = static_cast<double>(kPoints.size());
  return kPoints[static_cast<std::size_t>(std::lround(within_turn(azimuth_deg) / 360 * points)) % kPoints.size()];
}

}  // namespace itin
