// Polylines without the points that make no difference.
#pragma once

#include <span>
#include <vector>

#include <itin/geometry.hpp>

namespace itin {

/// Returns some of the points, both ends among them, so that none left out is farther than `tolerance` from the line
/// (Douglas and Peucker).
std::vector<Point2> simplified(std::span<const Point2> points, double tolerance);

}  // namespace itin
