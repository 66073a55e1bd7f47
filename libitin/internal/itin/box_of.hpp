// The smallest box of positions on the grid.
//
//   box_of(tin.vertices);
//   box_of(triangle, [&](std::uint32_t v) { return tin.vertices[v]; })
#pragma once

#include <functional>
#include <ranges>

#include <itin/geometry.hpp>

namespace itin {

/// Returns the box of all items; `position` tells where an item is: something with whole numbers x and y.
template <std::ranges::input_range Items, class Projection = std::identity>
GridBox box_of(const Items& items, const Projection& position = {}) {
  GridBox box;
  for (const auto& item : items) {
    const auto& at = std::invoke(position, item);
    box.extend(at.x, at.y);
  }
  return box;
}

}  // namespace itin
