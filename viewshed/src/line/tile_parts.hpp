// Some cells of a tile, as boxes of cells.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <itin/raster.hpp>

#include "line/cell_tiles.hpp"

namespace itin::viewshed {

/// The number of cells in all parts.
std::size_t cell_count(std::span<const Tile> parts);

/// Some parts of a tile, whose cells lie as far apart as the tile's.
struct PartsOfTile {
  std::size_t tile;
  std::vector<Tile> parts;
};
std::vector<PartsOfTile> by_tile(std::span<const Tile> parts, const RasterGrid& tiles);
/// All cells of these tiles.
std::vector<PartsOfTile> all_cells(const RasterGrid& grid, const RasterGrid& tiles,
                                   std::span<const std::size_t> numbers);

/// Calls visit(cell in the tile) for each cell of the parts.
template <class Visit>
void for_each_cell(std::span<const Tile> parts, const Tile& tile, const Visit& visit) {
  for (const Tile& part : parts) {
    const std::size_t first = tile.cell({part.column, part.row});
    for_each_cell(part, [&](std::size_t cell, RasterGrid::Cell) { visit(first + cell); });
  }
}

}  // namespace itin::viewshed
