// Rectangles of cells, halved between their tiles.
#pragma once

#include <utility>

#include "line/cell_tiles.hpp"
#include "plan/partition.hpp"

namespace itin::viewshed {

/// Halves a rectangle that begins where a tile does, and is larger than one tile, so that both halves begin so.
inline std::pair<CellRectangle, CellRectangle> halves_between_tiles(const CellRectangle& cells) {
  return halves(cells, [](std::int64_t n) { return (n / Tile::kSide + 1) / 2 * Tile::kSide; });
}

}  // namespace itin::viewshed
