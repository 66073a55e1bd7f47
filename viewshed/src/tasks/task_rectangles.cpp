#include "tasks/task_rectangles.hpp"

#include "plan/partition.hpp"
#include "plan/tile_halves.hpp"

namespace itin::viewshed {

std::vector<CellRectangle> task_rectangles(const RasterGrid& grid, std::uint64_t most_cells) {
  return parts_that_fit(
      all_cells(grid),
      [&](const CellRectangle& cells) {
        return cells.count() <= most_cells || (cells.columns <= Tile::kSide && cells.rows <= Tile::kSide);
      },
      halves_between_tiles);
}

}  // namespace itin::viewshed
