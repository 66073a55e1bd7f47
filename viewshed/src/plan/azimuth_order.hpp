// Places in the order in which one looks around: neighbours share the ground on the way.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <itin/geometry.hpp>

namespace itin::viewshed {

/// The azimuth clockwise from north, radians from -pi to pi.
inline double azimuth(Point2 from, Point2 to) {
  return std::atan2(to.x - from.x, to.y - from.y);
}

/// Sorts numbers from the south clockwise about a place; position_of(number) is where each of them lies.
template <class PositionOf>
void sort_by_azimuth(Point2 about, const PositionOf& position_of, std::vector<std::size_t>& numbers) {
  std::vector<std::pair<double, std::size_t>> order;
  for (const std::size_t number : numbers) order.emplace_back(azimuth(about, position_of(number)), number);
  std::sort(order.begin(), order.end());
  std::transform(order.begin(), order.end(), numbers.begin(), [](const auto& placed) { return placed.second; });
}

}  // namespace itin::viewshed
