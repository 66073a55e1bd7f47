// The convex hull of anything that has places in the plane (A. M. Andrew's monotone chain).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace itin {

/// Returns the corners counterclockwise, without items inside the hull's edges. `before(a, b)` orders by x, then y;
/// `turns_left(a, b, c)` holds strictly. Fewer than three items are returned in order. O(n log n).
template <class Item, class Before, class TurnsLeft>
std::vector<Item> convex_hull(std::vector<Item> items, const Before& before, const TurnsLeft& turns_left) {
  std::sort(items.begin(), items.end(), before);
  if (items.size() < 3) return items;
  std::vector<Item> hull;
  for (int chain = 0; chain < 2; ++chain) {
    const std::size_t base = hull.size();
    for (const Item& item : items) {
      while (hull.size() >= base + 2 && !turns_left(hull[hull.size() - 2], hull.back(), item)) hull.pop_back();
      hull.push_back(item);
    }
    hull.pop_back();
    std::reverse(items.begin(), items.end());
  }
  return hull;
}

}  // namespace itin
