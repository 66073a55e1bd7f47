// How low and how high a surface is within small squares: bounds that hold at every point of a square, not only at
// vertices.
//
//   BinnedHeights bins(tin, boundary_edges(tin));
//   bins.row(row)[column].high                              // grid units
//   for (std::uint32_t t : bins.triangles(column, row)) ...
//
// Positions are in bins, columns counted eastwards and rows southwards from the north-west corner.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <itin/raster.hpp>
#include <itin/tin.hpp>

#include "boundary.hpp"
#include "triangle_bins.hpp"

namespace itin::viewshed {

class BinnedHeights {
 public:
  /// About two triangles' worth a bin; 40 bytes a triangle. `boundary` is the Tin's.
  BinnedHeights(const Tin& tin, const std::vector<BoundaryEdge>& boundary);

  /// `low` is -infinity where part of the bin has no surface, `high` where all of it has none. Single precision,
  /// rounded outwards.
  struct Bounds {
    float low = -std::numeric_limits<float>::infinity();
    float high = -std::numeric_limits<float>::infinity();
  };

  std::int64_t columns() const { return grid_.columns(); }
  std::int64_t rows() const { return grid_.rows(); }
  /// Grid units.
  double bin_size() const { return grid_.cell_width() / units_.resolution; }
  /// In bins, of a position in grid units.
  double column_at(double x) const { return grid_.column_at(units_.origin.x + x * units_.resolution); }
  double row_at(double y) const { return grid_.row_at(units_.origin.y + y * units_.resolution); }

  /// A row's bounds from west to east, and a column's from north to south.
  std::span<const Bounds> row(std::int64_t row) const { return line(by_row_, row, columns()); }
  std::span<const Bounds> column(std::int64_t column) const { return line(by_column_, column, rows()); }
  /// Those that meet the bin, or nearly meet it: kSlack bins away at least.
  std::span<const std::uint32_t> triangles(std::int64_t column, std::int64_t row) const {
    return bins_.triangles(grid_.index({column, row}));
  }
  static constexpr double kSlack = 1e-7;
  /// A triangle's highest vertex, grid units.
  std::int32_t top(std::uint32_t triangle) const { return tops_[triangle]; }
  /// Of the surface, grid units.
  double greatest_magnitude() const { return greatest_magnitude_; }

 private:
  static std::span<const Bounds> line(const std::vector<Bounds>& all, std::int64_t number, std::int64_t length) {
    return std::span(all).subspan(static_cast<std::size_t>(number * length), static_cast<std::size_t>(length));
  }
  Bounds bounds_of(const Tin& tin, std::int64_t column, std::int64_t row) const;
  void forget_depth_at(const Tin& tin, const std::vector<BoundaryEdge>& boundary);

  Grid units_;
  RasterGrid grid_;
  TriangleBins bins_;
  std::vector<std::int32_t> tops_;
  std::vector<Bounds> by_row_, by_column_;
  double greatest_magnitude_ = 0;
};

}  // namespace itin::viewshed
