// How low and how high a surface is within small squares: bounds that hold at every point of a square, not only at
// vertices.
//
//   BinnedHeights bins(tin, boundary_edges(tin));
//   bins.high_by_row()[row * bins.columns() + column]          // grid units
//   for (std::uint32_t t : bins.triangles(column, row)) ...
//
// Positions are in bins, columns counted eastwards and rows southwards from the north-west corner.
#pragma once

#include <cstdint>
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

  std::int64_t columns() const { return grid_.columns(); }
  std::int64_t rows() const { return grid_.rows(); }
  /// Grid units.
  double bin_size() const { return grid_.cell_width() / units_.resolution; }
  /// In bins, of a position in grid units.
  double column_at(double x) const { return grid_.column_at(units_.origin.x + x * units_.resolution); }
  double row_at(double y) const { return grid_.row_at(units_.origin.y + y * units_.resolution); }

  /// Grid units, in single precision rounded outwards: the lowest is -infinity where part of the bin has no surface, the
  /// highest where all of it has none. Row by row from the north-west, and column by column.
  std::span<const float> low_by_row() const { return low_by_row_; }
  std::span<const float> high_by_row() const { return high_by_row_; }
  std::span<const float> low_by_column() const { return low_by_column_; }
  std::span<const float> high_by_column() const { return high_by_column_; }
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
  void bound(const Tin& tin, std::int64_t column, std::int64_t row);
  void forget_depth_at(const Tin& tin, const std::vector<BoundaryEdge>& boundary);
  void transpose();

  Grid units_;
  RasterGrid grid_;
  TriangleBins bins_;
  std::vector<std::int32_t> tops_;
  std::vector<float> low_by_row_, high_by_row_, low_by_column_, high_by_column_;
  double greatest_magnitude_ = 0;
};

}  // namespace itin::viewshed
