#include "line/cell_tiles.hpp"

#include <algorithm>
#include <cmath>

#include <itin/grid_units.hpp>

namespace itin::viewshed {

RasterGrid grid_of_tiles(const RasterGrid& cells) {
  constexpr auto kSide = static_cast<double>(Tile::kSide);
  return {cells.north_west(), cells.cell_width() * kSide, cells.cell_height() * kSide,
          (cells.columns() + Tile::kSide - 1) / Tile::kSide, (cells.rows() + Tile::kSide - 1) / Tile::kSide};
}

Tile tile_at(const RasterGrid& cells, const RasterGrid& tiles, std::size_t index) {
  const RasterGrid::Cell tile = place_of(tiles, index);
  const std::int64_t column = tile.column * Tile::kSide, row = tile.row * Tile::kSide;
  return {column, row, std::min(Tile::kSide, cells.columns() - column), std::min(Tile::kSide, cells.rows() - row)};
}

namespace {

/// The first of a row of cells that lies amid `step` cells on a multiple of their size, where the row's edge is
/// `before` cells from a multiple of all.
std::int64_t first_amid(double before, std::int64_t step) {
  const std::int64_t past = std::llround(before) % step;
  return (step / 2 - past + step) % step;
}

/// How many of `cells` cells lie at `first` and every `step` cells after it.
std::int64_t count_from(std::int64_t first, std::int64_t cells, std::int64_t step) {
  return first < cells ? (cells - first - 1) / step + 1 : 0;
}

}  // namespace

SteppedTiles::SteppedTiles(const RasterGrid& grid, std::int64_t step)
    : step_(step),
      first_{first_amid(grid.north_west().x / grid.cell_width(), step),
             first_amid(-grid.north_west().y / grid.cell_height(), step)},
      columns_(count_from(first_.column, grid.columns(), step)),
      rows_(count_from(first_.row, grid.rows(), step)) {}

Tile SteppedTiles::tile(std::size_t index) const {
  const auto number = static_cast<std::int64_t>(index), across = tiles_along(columns_);
  const std::int64_t column = number % across * Tile::kSide, row = number / across * Tile::kSide;
  return {first_.column + column * step_, first_.row + row * step_, std::min(Tile::kSide, columns_ - column),
          std::min(Tile::kSide, rows_ - row), step_};
}

CellRectangle cells_meeting(const RasterGrid& grid, const Box& box) {
  const auto at = [](double v, std::int64_t count) {
    return static_cast<std::int64_t>(std::clamp(v, 0.0, static_cast<double>(count)));
  };
  const std::int64_t west = at(std::floor(grid.column_at(box.xmin)), grid.columns()),
                     east = at(std::ceil(grid.column_at(box.xmax)), grid.columns()),
                     north = at(std::floor(grid.row_at(box.ymax)), grid.rows()),
                     south = at(std::ceil(grid.row_at(box.ymin)), grid.rows());
  return {west, north, east - west, south - north};
}

RasterGrid::Cell place_of(const RasterGrid& grid, std::size_t index) {
  const auto number = static_cast<std::int64_t>(index);
  return {number % grid.columns(), number / grid.columns()};
}

TileCentres::TileCentres(const Grid& units, const RasterGrid& grid, const Tile& tile) {
  for (std::int64_t c = 0; c < tile.columns; ++c)
    x[static_cast<std::size_t>(c)] = easting_in_units(units, grid.centre_x(tile.column + c * tile.step));
  for (std::int64_t r = 0; r < tile.rows; ++r)
    y[static_cast<std::size_t>(r)] = northing_in_units(units, grid.centre_y(tile.row + r * tile.step));
}

Box box_of(const RasterGrid& grid, const Tile& tile) {
  const Box centres = box_of_centres(grid, tile);
  const double half_width = grid.cell_width() / 2, half_height = grid.cell_height() / 2;
  return {centres.xmin - half_width, centres.ymin - half_height, centres.xmax + half_width, centres.ymax + half_height};
}

Box box_of_centres(const RasterGrid& grid, const Tile& tile) {
  return {grid.centre_x(tile.column), grid.centre_y(tile.row + (tile.rows - 1) * tile.step),
          grid.centre_x(tile.column + (tile.columns - 1) * tile.step), grid.centre_y(tile.row)};
}

Box box_of_cell(const RasterGrid& grid, RasterGrid::Cell cell) {
  return box_of(grid, Tile{cell.column, cell.row, 1, 1});
}

double squared_distance(Point2 position, const Box& box) {
  const double dx = position.x - std::clamp(position.x, box.xmin, box.xmax),
               dy = position.y - std::clamp(position.y, box.ymin, box.ymax);
  return dx * dx + dy * dy;
}

double greatest_squared_distance(Point2 position, const Box& box) {
  const double dx = std::max(std::abs(position.x - box.xmin), std::abs(position.x - box.xmax)),
               dy = std::max(std::abs(position.y - box.ymin), std::abs(position.y - box.ymax));
  return dx * dx + dy * dy;
}

}  // namespace itin::viewshed
