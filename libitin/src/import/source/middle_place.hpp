// A place amid the first features of a file, for which its CRS and the store's grid are chosen.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

#include <itin/geometry.hpp>

namespace itin {

/// As many features, or rows, are looked at.
inline constexpr std::size_t kFirstPlaces = 100;

/// The place nearest to the middle by x and by y. A single one that lies far off, with swapped axes or at 0, 0, hardly
/// counts among several. Precondition: there is a place.
inline Point2 middle_place(std::vector<Point2> places) {
  const auto middle = places.begin() + static_cast<std::ptrdiff_t>((places.size() - 1) / 2);
  std::nth_element(places.begin(), middle, places.end(), [](Point2 p, Point2 q) { return p.x < q.x; });
  const double x = middle->x;
  std::nth_element(places.begin(), middle, places.end(), [](Point2 p, Point2 q) { return p.y < q.y; });
  const double y = middle->y;
  const auto off = [&](Point2 p) { return std::tuple(std::hypot(p.x - x, p.y - y), p.x, p.y); };
  return *std::min_element(places.begin(), places.end(), [&](Point2 p, Point2 q) { return off(p) < off(q); });
}

}  // namespace itin
