#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/raster.hpp>

namespace itin {

namespace {

/// Box edges given in decimal rarely are exact multiples of a decimal cell size.
constexpr double kSnap = 1e-6;

double floor_multiple(double v, double step) {
  return std::floor(v / step + kSnap);
}
double ceil_multiple(double v, double step) {
  return std::ceil(v / step - kSnap);
}

}  // namespace

RasterGrid::RasterGrid(Point2 north_west, double cell_width, double cell_height, std::int64_t columns,
                       std::int64_t rows)
    : origin_(north_west), cell_width_(cell_width), cell_height_(cell_height), columns_(columns), rows_(rows) {
  if (!std::isfinite(north_west.x) || !std::isfinite(north_west.y))
    throw InputError("raster: its corner is not a finite position");
  if (!(std::isfinite(cell_width) && std::isfinite(cell_height) && cell_width > 0 && cell_height > 0))
    throw InputError(fmt::format("raster: cells of {} x {} m; give a positive cell size", cell_width, cell_height));
  if (columns < 1 || rows < 1 || columns > kMaxSide || rows > kMaxSide || columns > kMaxCells / rows)
    throw InputError(
        fmt::format("raster: {} x {} cells of {:g} m; give larger cells or a smaller area", columns, rows, cell_width));
}

RasterGrid RasterGrid::aligned(const Box& box, double cell_size) {
  if (box.empty()) throw InputError("raster: the area is empty");
  if (!(std::isfinite(cell_size) && cell_size > 0))
    throw InputError(fmt::format("cell size {}: give a positive number of metres", cell_size), "cell_size");
  const double west = floor_multiple(box.xmin, cell_size), east = ceil_multiple(box.xmax, cell_size);
  const double south = floor_multiple(box.ymin, cell_size), north = ceil_multiple(box.ymax, cell_size);
  const double columns = std::max(1.0, east - west), rows = std::max(1.0, north - south);
  if (!(columns <= kMaxCells && rows <= kMaxCells))
    throw InputError(fmt::format("cell size {:g}: the raster would have {:.3g} x {:.3g} cells; give a larger one",
                                 cell_size, columns, rows),
                     "cell_size");
  return {{west * cell_size, (south + rows) * cell_size},
          cell_size,
          cell_size,
          static_cast<std::int64_t>(columns),
          static_cast<std::int64_t>(rows)};
}

Box RasterGrid::bounds() const {
  if (columns_ == 0) return {};
  return {edge_x(0), edge_y(rows_), edge_x(columns_), edge_y(0)};
}

RasterGrid RasterGrid::part(Cell north_west, std::int64_t columns, std::int64_t rows) const {
  const bool within = north_west.column >= 0 && north_west.row >= 0 && columns >= 1 && rows >= 1 &&
                      columns <= columns_ - north_west.column && rows <= rows_ - north_west.row;
  if (!within)
    throw InputError(fmt::format("raster: {} x {} cells from column {}, row {} on are no part of {} x {} cells",
                                 columns, rows, north_west.column, north_west.row, columns_, rows_));
  RasterGrid part = *this;
  part.first_ = {first_.column + north_west.column, first_.row + north_west.row};
  part.columns_ = columns;
  part.rows_ = rows;
  return part;
}

std::optional<RasterGrid::Cell> RasterGrid::cell_at(Point2 p) const {
  const double column = std::floor(column_at(p.x)), row = std::floor(row_at(p.y));
  const bool inside =
      column >= 0 && row >= 0 && column < static_cast<double>(columns_) && row < static_cast<double>(rows_);
  if (!inside) return std::nullopt;
  return Cell{static_cast<std::int64_t>(column), static_cast<std::int64_t>(row)};
}

}  // namespace itin
