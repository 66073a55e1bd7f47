// The cells of a raster in tiles: square blocks of cells that are decided together, each by one thread.
//
//   const RasterGrid tiles = grid_of_tiles(grid);
//   for (std::size_t i = 0; i < tiles.cell_count(); ++i) {
//     const Tile tile = tile_at(grid, tiles, i);
//     TileValues<double> values;
//     ...
//     for_each_cell(tile, [&](std::size_t cell, RasterGrid::Cell place) { raster[grid.index(place)] = values[cell]; });
//   }
//
// `cell` is always a cell's index in its tile, and a place one of the whole grid. Boxes are in metres.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <itin/geometry.hpp>
#include <itin/raster.hpp>

namespace itin::viewshed {

struct Tile {
  static constexpr std::int64_t kSide = 64;
  std::int64_t column = 0;  ///< where its north-west cell is
  std::int64_t row = 0;
  std::int64_t columns = 0;  ///< at most kSide
  std::int64_t rows = 0;
  std::int64_t step = 1;  ///< its cells lie so many columns and rows of the grid apart

  /// The index of one of its cells.
  std::size_t cell(RasterGrid::Cell place) const {
    return static_cast<std::size_t>((place.row - row) / step * kSide + (place.column - column) / step);
  }
};

/// One value per cell of a tile, row by row, kSide to a row.
template <class T>
using TileValues = std::array<T, Tile::kSide * Tile::kSide>;

/// The tiles of a grid as the cells of a coarser grid, and the tile that is cell `index` of the coarser grid.
RasterGrid grid_of_tiles(const RasterGrid& cells);
Tile tile_at(const RasterGrid& cells, const RasterGrid& tiles, std::size_t index);

/// The cells of a grid that lie at every `step`-th column and row, in tiles. The step is odd. Where edges are multiples
/// of the cell size, these cells share their centres with cells `step` times as large on edges that are multiples of
/// theirs, so that whatever part of such a grid is looked at, the same cells are chosen.
class SteppedTiles {
 public:
  SteppedTiles(const RasterGrid& grid, std::int64_t step);

  std::size_t count() const { return static_cast<std::size_t>(tiles_along(columns_) * tiles_along(rows_)); }
  Tile tile(std::size_t index) const;

 private:
  static std::int64_t tiles_along(std::int64_t cells) { return (cells + Tile::kSide - 1) / Tile::kSide; }

  std::int64_t step_;
  RasterGrid::Cell first_;       ///< the north-west one
  std::int64_t columns_, rows_;  ///< how many there are; 0 where the grid has none
};

/// A rectangle of cells of any size.
struct CellRectangle {
  std::int64_t column = 0, row = 0;  ///< where its north-west cell is
  std::int64_t columns = 0, rows = 0;

  std::uint64_t count() const { return static_cast<std::uint64_t>(columns * rows); }
  /// The cells row by row, the north-west one first.
  RasterGrid::Cell cell(std::size_t i) const {
    const auto n = static_cast<std::int64_t>(i);
    return {column + n % columns, row + n / columns};
  }
};

inline CellRectangle all_cells(const RasterGrid& grid) {
  return {0, 0, grid.columns(), grid.rows()};
}

/// The cells that the inside of a box meets; cells that it only touches are left out. Has no columns or no rows where
/// the box lies beside the grid.
CellRectangle cells_meeting(const RasterGrid& grid, const Box& box);

/// The inverse of RasterGrid::index().
RasterGrid::Cell place_of(const RasterGrid& grid, std::size_t index);

/// Calls visit(cell, place) for each of a tile's cells, row by row.
template <class Visit>
void for_each_cell(const Tile& tile, const Visit& visit) {
  for (std::int64_t r = 0; r < tile.rows; ++r)
    for (std::int64_t c = 0; c < tile.columns; ++c)
      visit(static_cast<std::size_t>(r * Tile::kSide + c),
            RasterGrid::Cell{tile.column + c * tile.step, tile.row + r * tile.step});
}

/// Calls visit(cell, place) for the first cell of each of a tile's rows, in which its tile.columns cells lie tile.step
/// places apart.
template <class Visit>
void for_each_row(const Tile& tile, const Visit& visit) {
  for (std::int64_t r = 0; r < tile.rows; ++r)
    visit(static_cast<std::size_t>(r * Tile::kSide), RasterGrid::Cell{tile.column, tile.row + r * tile.step});
}

/// The positions of a tile's cell centres, in grid units.
struct TileCentres {
  TileCentres(const Grid& units, const RasterGrid& grid, const Tile& tile);
  Point2 at(std::size_t cell) const { return {x[cell % Tile::kSide], y[cell / Tile::kSide]}; }

  std::array<double, Tile::kSide> x{};  ///< per column
  std::array<double, Tile::kSide> y{};  ///< per row
};

/// The box about a tile's cells, and the box about their centres alone.
Box box_of(const RasterGrid& grid, const Tile& tile);
Box box_of_centres(const RasterGrid& grid, const Tile& tile);
/// The box about a single cell.
Box box_of_cell(const RasterGrid& grid, RasterGrid::Cell cell);

/// The squared distance from a position to the nearest place of a box, metres squared; 0 within the box.
double squared_distance(Point2 position, const Box& box);
/// The squared distance from a position to the farthest place of a box.
double greatest_squared_distance(Point2 position, const Box& box);

inline Point2 middle_of(const Box& box) {
  return {(box.xmin + box.xmax) / 2, (box.ymin + box.ymax) / 2};
}

}  // namespace itin::viewshed
