// Rasters that results are written on: where their cells lie, and how they get into files.
//
//   const RasterGrid grid = RasterGrid::aligned({318000, 176000, 328000, 186000}, 10);
//   std::vector<float> eastings(grid.cell_count());
//   for (std::int64_t row = 0; row < grid.rows(); ++row)
//     for (std::int64_t column = 0; column < grid.columns(); ++column)
//       eastings[grid.index({column, row})] = static_cast<float>(grid.centre(column, row).x);
//   RasterDescription description;
//   description.crs_wkt = store.metadata().crs_wkt;
//   write_raster("eastings.tif", grid, std::span<const float>(eastings), description);
//
// North is up: row 0 is the northernmost, and values lie row by row from west to east. This file is the only place that
// knows how rows map to northings and where a cell's centre is.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>

namespace itin {

class RasterGrid {
 public:
  struct Cell {
    std::int64_t column = 0;
    std::int64_t row = 0;
    friend bool operator==(const Cell&, const Cell&) = default;
  };

  RasterGrid() = default;
  /// Makes a grid from its north-west corner. Throws InputError unless sizes are positive and counts are at least 1 and
  /// within the limits below.
  RasterGrid(Point2 north_west, double cell_width, double cell_height, std::int64_t columns, std::int64_t rows);
  /// Returns the smallest grid of square cells over the box whose cell edges are multiples of the cell size. A box edge
  /// within a millionth of a cell of such a multiple counts as lying on it. Throws InputError as the constructor does,
  /// and for an empty box.
  static RasterGrid aligned(const Box& box, double cell_size);

  /// Returns a part of these cells as a grid of its own; its centres are the same as in this grid to the last bit.
  /// Throws InputError unless all its cells are cells of this grid.
  RasterGrid part(Cell north_west, std::int64_t columns, std::int64_t rows) const;

  static constexpr std::int64_t kMaxCells = std::int64_t{1} << 33;
  static constexpr std::int64_t kMaxSide = 0x7fffffff;  ///< the most that GDAL counts

  std::int64_t columns() const { return columns_; }
  std::int64_t rows() const { return rows_; }
  std::size_t cell_count() const { return static_cast<std::size_t>(columns_ * rows_); }
  double cell_width() const { return cell_width_; }
  double cell_height() const { return cell_height_; }
  double cell_area() const { return cell_width_ * cell_height_; }
  Point2 north_west() const { return {edge_x(0), edge_y(0)}; }
  Box bounds() const;

  double centre_x(std::int64_t column) const {
    return origin_.x + (static_cast<double>(first_.column + column) + 0.5) * cell_width_;
  }
  double centre_y(std::int64_t row) const {
    return origin_.y - (static_cast<double>(first_.row + row) + 0.5) * cell_height_;
  }
  Point2 centre(std::int64_t column, std::int64_t row) const { return {centre_x(column), centre_y(row)}; }
  /// Tells where a position lies in units of cells from the north-west corner: centre_x(c) is at c + 0.5.
  double column_at(double x) const { return (x - origin_.x) / cell_width_ - static_cast<double>(first_.column); }
  double row_at(double y) const { return (origin_.y - y) / cell_height_ - static_cast<double>(first_.row); }
  /// Returns the cell that holds a position; on a shared edge, the eastern or southern neighbour. Nothing outside the
  /// grid.
  std::optional<Cell> cell_at(Point2 p) const;
  std::size_t index(Cell cell) const { return static_cast<std::size_t>(cell.row * columns_ + cell.column); }

  friend bool operator==(const RasterGrid&, const RasterGrid&) = default;

 private:
  /// The western edge of a column, the northern edge of a row.
  double edge_x(std::int64_t column) const {
    return origin_.x + static_cast<double>(first_.column + column) * cell_width_;
  }
  double edge_y(std::int64_t row) const { return origin_.y - static_cast<double>(first_.row + row) * cell_height_; }

  Point2 origin_;  ///< the north-west corner of the grid that this is a part of, or else of this grid
  Cell first_;     ///< the north-west cell of this grid, counted in that one
  double cell_width_ = 1;
  double cell_height_ = 1;
  std::int64_t columns_ = 0;
  std::int64_t rows_ = 0;
};

/// Returns the grid of an existing raster file. Throws FileError if GDAL cannot read it; InputError if its rows do not
/// run from west to east (rotated) or if its CRS and `crs_wkt` are both known and differ.
RasterGrid raster_grid_like(const std::string& path, const std::string& crs_wkt);

/// The place of the bit that tells whether thing `number` (from 0) is in the set of a cell. A raster of sets consists
/// of grids of 32-bit words, one for every 32 things, one grid after the other.
struct RasterBit {
  std::size_t grid = 0;
  std::uint32_t mask = 0;
};
constexpr RasterBit raster_bit(std::size_t number) {
  return {number / 32, std::uint32_t{1} << (number % 32)};
}
/// How many grids a raster of sets of `count` things has.
constexpr std::size_t bit_grids(std::size_t count) {
  return (count + 31) / 32;
}

/// A colour; its opacity is 255 where nothing shows through.
struct Rgba {
  std::uint8_t red = 0, green = 0, blue = 0, alpha = 255;

  friend bool operator==(const Rgba&, const Rgba&) = default;
};
inline constexpr Rgba kTransparent{0, 0, 0, 0};

/// A value that stands for a class.
struct RasterClass {
  int value = 0;
  std::string name = {};
  Rgba colour = {};
};

struct RasterDescription {
  std::string crs_wkt = {};  ///< may be empty: unknown
  std::optional<double> nodata = {};
  std::string band_name = {};                   ///< may be empty
  std::vector<std::string> further_bands = {};  ///< names of the second band and those after it
  std::vector<RasterClass> classes = {};        ///< if not empty: colour table and category names (Byte only)
  std::vector<std::pair<std::string, std::string>> metadata = {};  ///< name, value
  bool overwrite = false;                                          ///< an existing file may be replaced
};

/// Writes a cloud-optimised GeoTIFF: tiled, compressed, with overviews (the most frequent value for classes, the
/// nearest otherwise). There are grid.cell_count() values a band, one band after the other. The file appears under its
/// name only when it is complete; its bytes do not depend on the number of threads. Throws FileError if the place
/// cannot be written or the file exists and may not be replaced; Cancelled, which leaves an existing file as it was.
void write_raster(const std::string& path, const RasterGrid& grid, std::span<const std::uint8_t> values,
                  const RasterDescription& description, const Progress& progress = NoProgress());
void write_raster(const std::string& path, const RasterGrid& grid, std::span<const std::uint16_t> values,
                  const RasterDescription& description, const Progress& progress = NoProgress());
void write_raster(const std::string& path, const RasterGrid& grid, std::span<const std::uint32_t> values,
                  const RasterDescription& description, const Progress& progress = NoProgress());
void write_raster(const std::string& path, const RasterGrid& grid, std::span<const float> values,
                  const RasterDescription& description, const Progress& progress = NoProgress());

}  // namespace itin
