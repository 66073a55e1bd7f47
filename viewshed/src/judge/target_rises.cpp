#include "judge/target_rises.hpp"

#include <algorithm>

#include <itin/parallel.hpp>

#include "request/request.hpp"

namespace itin::viewshed {

TargetRises::TargetRises(const Store& store, const Request& request, const RasterGrid& grid) {
  if (!request.targets_on_surface || !has_raised_features(store, request)) return;
  columns_ = (grid.columns() + kSide - 1) / kSide;
  rises_.resize(static_cast<std::size_t>(columns_ * ((grid.rows() + kSide - 1) / kSide)));
  const RasterGrid tiles = grid_of_tiles(grid);
  parallel_for(tiles.cell_count(), [&](std::size_t i) { raise(store, request.themes, grid, tile_at(grid, tiles, i)); });
}

void TargetRises::raise(const Store& store, const ThemeChoice& themes, const RasterGrid& grid, const Tile& tile) {
  const double resolution = store.metadata().grid.resolution;
  const bool bare = store.greatest_feature_height(themes, box_of(grid, tile)) == 0;
  for (std::int64_t row = tile.row; row < tile.row + tile.rows; row += kSide) {
    for (std::int64_t column = tile.column; column < tile.column + tile.columns; column += kSide) {
      const Tile box{column, row, std::min(kSide, tile.column + tile.columns - column),
                     std::min(kSide, tile.row + tile.rows - row)};
      const double height = bare ? 0 : store.greatest_feature_height(themes, box_of(grid, box));
      // A grid unit is added against rounding.
      rises_[static_cast<std::size_t>(row / kSide * columns_ + column / kSide)] = height / resolution + 1;
    }
  }
}

double TargetRises::over(const Tile& tile, const CellBlock& block) const {
  double rise = 0;
  if (rises_.empty()) return rise;
  const auto box = [](std::int64_t first, std::size_t cell) {
    return (first + static_cast<std::int64_t>(cell)) / kSide;
  };
  for (std::int64_t row = box(tile.row, block.row); row <= box(tile.row, block.row_end - 1); ++row)
    for (std::int64_t c = box(tile.column, block.column); c <= box(tile.column, block.column_end - 1); ++c)
      rise = std::max(rise, rises_[static_cast<std::size_t>(row * columns_ + c)]);
  return rise;
}

}  // namespace itin::viewshed
