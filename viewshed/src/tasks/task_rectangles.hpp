// The cells of a raster in rectangles, each the cells of a task.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/raster.hpp>
#include <viewshed/tasks.hpp>

#include "line/cell_tiles.hpp"

namespace itin::viewshed {

/// Halves all cells between their tiles, until each rectangle has no more than `most_cells` cells or is a single tile.
std::vector<CellRectangle> task_rectangles(const RasterGrid& grid, std::uint64_t most_cells);

inline CellRectangle cells_of(const Task& task) {
  return {task.north_west.column, task.north_west.row, task.columns, task.rows};
}
/// Returns a task of these cells, of which nothing else is known yet.
inline Task task_of(const CellRectangle& cells) {
  return {{cells.column, cells.row}, cells.columns, cells.rows};
}

}  // namespace itin::viewshed
