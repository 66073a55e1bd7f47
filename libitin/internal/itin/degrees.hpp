// Angles in degrees and in radians.
#pragma once

#include <numbers>

namespace itin {

constexpr double in_degrees(double radians) {
  return radians * (180 / std::numbers::pi);
}
constexpr double in_radians(double degrees) {
  return degrees / (180 / std::numbers::pi);
}

}  // namespace itin
