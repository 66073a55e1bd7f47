// When two places are one, for every answer alike (law 4): nothing stands between such places, so that each sees the
// other, straight up, straight down or level.
#pragma once

#include <itin/geometry.hpp>

namespace itin {

/// The distance below which two places are one, in steps of the store's grid, which tells no finer positions apart. It
/// is a thousandth less than a step, so that neighbours on the grid stay two places however they are rounded.
inline constexpr double kSamePlace = 0.999;

/// Tells whether two places that are `dx`, `dy` apart in plan, grid units, are one.
constexpr bool same_place(double dx, double dy) {
  return dx * dx + dy * dy < kSamePlace * kSamePlace;
}
/// Tells whether two places, in metres, are one.
constexpr bool same_place(const Grid& grid, Point2 a, Point2 b) {
  return same_place((a.x - b.x) / grid.resolution, (a.y - b.y) / grid.resolution);
}

}  // namespace itin
