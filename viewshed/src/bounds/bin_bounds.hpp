// How low and how high a surface is within small squares, its bins: bounds that hold at every point of a square, not
// only at vertices. The derived classes know what the surface is made of: triangles or posts (binned_heights.hpp), or
// two surfaces that enclose it (envelope_bounds.hpp).
//
// Positions are in bins, columns counted eastwards and rows southwards from the north-west corner.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <itin/geometry.hpp>
#include <itin/grid_units.hpp>
#include <itin/raster.hpp>
#include <itin/tin.hpp>

#include "bounds/run_bounds.hpp"
#include "line/infinity.hpp"

namespace itin::viewshed {

/// A closed box, in bins.
struct BinBox {
  double west = 0, north = 0, east = 0, south = 0;
};

struct BinRange {
  std::int64_t west, east, north, south;  ///< inclusive; empty when west > east or north > south
};

/// The bin of `count` that a position lies in: -1 before the first, `count` after the last. Rounds down without a call
/// of std::floor().
inline std::int64_t bin_at(double v, std::int64_t count) {
  const double clamped = std::clamp(v, -1.0, static_cast<double>(count));
  const auto whole = static_cast<std::int64_t>(clamped);
  return whole - (clamped < static_cast<double>(whole) ? 1 : 0);
}

/// Returns square bins of side `bin`, metres, over a box of this size and half a bin more all around, so that the box's
/// edges lie inside.
inline RasterGrid bins_over(Point2 north_west, double width, double height, double bin) {
  const auto count = [&](double length) { return static_cast<std::int64_t>(std::ceil(length / bin)) + 1; };
  return {{north_west.x - bin / 2, north_west.y + bin / 2}, bin, bin, count(width), count(height)};
}

/// The positions of the bins over a surface of these grid units.
class BinGrid {
 public:
  BinGrid(const Grid& units, const RasterGrid& grid) : units_(units), grid_(grid) {}

  const Grid& units() const { return units_; }
  const RasterGrid& grid() const { return grid_; }
  std::int64_t columns() const { return grid_.columns(); }
  std::int64_t rows() const { return grid_.rows(); }
  /// The side of a bin, grid units.
  double bin_size() const { return grid_.cell_width() / units_.resolution; }
  /// The column and the row, in bins, of a position in grid units.
  double column_at(double x) const { return grid_.column_at(units_.origin.x + x * units_.resolution); }
  double row_at(double y) const { return grid_.row_at(units_.origin.y + y * units_.resolution); }

  /// Converts a box in metres to bins.
  BinBox in_bins(const Box& metres) const {
    return {column_at(easting_in_units(units_, metres.xmin)), row_at(northing_in_units(units_, metres.ymax)),
            column_at(easting_in_units(units_, metres.xmax)), row_at(northing_in_units(units_, metres.ymin))};
  }

  /// The bins that a box meets, or nearly meets; -1, or the number of columns or rows, where it reaches beyond them.
  BinRange bins_about(const BinBox& box) const {
    constexpr double kHair = 1e-6;
    return {bin_at(box.west - kHair, columns()), bin_at(box.east + kHair, columns()), bin_at(box.north - kHair, rows()),
            bin_at(box.south + kHair, rows())};
  }

  /// A distance from a position that no part of the surface exceeds; grid units.
  double farthest_from(double x, double y) const {
    const double column = column_at(x), row = row_at(y);
    return bin_size() * std::hypot(std::max(std::abs(column), std::abs(column - static_cast<double>(columns()))),
                                   std::max(std::abs(row), std::abs(row - static_cast<double>(rows()))));
  }

 protected:
  ~BinGrid() = default;
  BinGrid(BinGrid&&) = default;

  const Grid units_;
  const RasterGrid grid_;
};

class BinBounds : public BinGrid {
 public:
  BinBounds(const BinBounds&) = delete;
  BinBounds& operator=(const BinBounds&) = delete;

  /// The bounds along runs, rounded outwards. Unread ground counts as bare.
  const RunBounds& runs() const { return runs_; }
  /// A height that no part of the surface within a box exceeds, grid units; nothing where the surface may not be there
  /// throughout. Rounded outwards to whole runs.
  std::optional<float> highest_where_covered(const BinBox& box) const;
  /// The surface's greatest absolute height, grid units.
  double greatest_magnitude() const { return greatest_magnitude_; }

 protected:
  BinBounds(const Grid& units, const RasterGrid& grid) : BinGrid(units, grid), runs_(grid.columns(), grid.rows()) {}
  ~BinBounds() = default;

  RunBounds runs_;
  double greatest_magnitude_ = 0;
};

inline std::optional<float> BinBounds::highest_where_covered(const BinBox& box) const {
  const auto [west, east, north, south] = bins_about(box);
  if (west < 0 || north < 0 || east >= columns() || south >= rows()) return std::nullopt;
  const RunBounds::Lines lines = runs_.eastwards();
  float highest = -kFloatInfinity;
  for (std::int64_t row = north; row <= south; ++row) {
    for (std::int64_t run = west / RunBounds::kRun; run <= east / RunBounds::kRun; ++run) {
      if (lines.low(run, row) == -kFloatInfinity) return std::nullopt;
      highest = std::max(highest, lines.high(run, row));
    }
  }
  return highest;
}

}  // namespace itin::viewshed
