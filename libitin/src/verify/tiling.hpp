// The cells in which a store is verified, one after the other.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/cell.hpp"

namespace itin {

/// Returns cells with at most `capacity` points each, along the curve, that together cover the root, including cells
/// that `points` finds empty. `points(cell)` returns about how many points a cell has.
template <class Points>
std::vector<Cell> tiles_of(const Points& points, double capacity, const Cell& cell = {}) {
  std::vector<Cell> tiles;
  const auto split = [&](const auto& self, const Cell& part) -> void {
    if (part.log2_side == 0 || points(part) <= capacity) return tiles.push_back(part);
    for (int i = 0; i < 4; ++i) self(self, part.child(i));
  };
  split(split, cell);
  return tiles;
}

/// Returns about `wanted` of the tiles, evenly spread; all of them if `wanted` is 0.
inline std::vector<Cell> sample_of(const std::vector<Cell>& tiles, std::size_t wanted) {
  if (wanted == 0 || wanted >= tiles.size()) return tiles;
  std::vector<Cell> some;
  for (std::size_t i = 0; i < wanted; ++i) some.push_back(tiles[i * tiles.size() / wanted]);
  return some;
}

}  // namespace itin
