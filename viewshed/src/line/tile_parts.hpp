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

/// Some parts of a tile.
struct PartsOfTile {
  std::size_t tile;
  std::vector<Tile> parts;
};
std::vector<PartsOfTile> by_tile(std::span<const Tile> parts, const RasterGrid& tiles);
/// All cells of these tiles, or of every tile of the grid.
std::vector<PartsOfTile> all_cells(const RasterGrid& grid, const RasterGrid& tiles,
                                   std::span<const std::size_t> numbers);
std::vector<PartsOfTile> all_cells(const RasterGrid& grid, const RasterGrid& tiles);

/// Calls visit(cell in the tile) for each cell of the parts.
template <class Visit>
void for_each_cell(const PartsOfTile& cells, const Tile& tile, const Visit& visit) {
  for (const Tile& part : cells.parts)
    for_each_cell(part, [&](std::size_t, RasterGrid::Cell place) { visit(tile.cell(place)); });
}

}  // namespace itin::viewshed
