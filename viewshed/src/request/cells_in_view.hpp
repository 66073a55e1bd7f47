// Which cells lie within observers' distances and azimuths, whether or not there is ground.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <itin/raster.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// 1 for those cells that `asked` holds for and that some observer looks at, at whatever elevation; else 0.
std::vector<std::uint8_t> cells_in_view(const Request& request, const RasterGrid& grid,
                                        const std::function<bool(RasterGrid::Cell)>& asked);

/// Cells beyond a grid.
struct CellsBeyond {
  RasterGrid grid;                  ///< of cells as large, or larger where they would be many
  std::vector<std::uint8_t> cells;  ///< 1 where an observer looks; empty: none
  double each = 1;                  ///< how many cells of the other grid fit into one

  double count() const;  ///< in cells of the other grid
};

/// What observers look at beyond the grid, where the request names no cells and the grid is cut to the data. None where
/// an observer has no radius.
CellsBeyond cells_beyond(const Request& request, const RasterGrid& grid);

}  // namespace itin::viewshed
