// How low and how high a surface is within small squares: bounds that hold at every point of a square, not only at
// vertices.
//
//   BinnedHeights bins(tin);
//   bins.lid(bin, column, row)                                // grid units
//   for (std::uint32_t t : bins.triangles(bin)) ...
//
// Positions are in bins, columns counted eastwards and rows southwards from the north-west corner.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <itin/raster.hpp>
#include <itin/tin.hpp>

#include "boundary.hpp"
#include "triangle_bins.hpp"

namespace itin::viewshed {

class BinnedHeights {
 public:
  /// About two triangles' worth a bin: the cells themselves where the Tin is a lattice, 25 bytes a triangle, and then
  /// four times as fast; 50 elsewhere.
  explicit BinnedHeights(const Tin& tin);

  std::int64_t columns() const { return grid_.columns(); }
  std::int64_t rows() const { return grid_.rows(); }
  /// Grid units.
  double bin_size() const { return grid_.cell_width() / units_.resolution; }
  /// In bins, of a position in grid units.
  double column_at(double x) const { return grid_.column_at(units_.origin.x + x * units_.resolution); }
  double row_at(double y) const { return grid_.row_at(units_.origin.y + y * units_.resolution); }

  /// At least as far from a position as any of the surface; grid units.
  double farthest_from(double x, double y) const {
    const double column = column_at(x), row = row_at(y);
    return bin_size() * std::hypot(std::max(std::abs(column), std::abs(column - static_cast<double>(columns()))),
                                   std::max(std::abs(row), std::abs(row - static_cast<double>(rows()))));
  }

  /// Bounds of runs of kRun bins, eastwards or southwards: as many lines of runs as there are rows, or columns. Grid
  /// units, in single precision rounded outwards.
  struct Runs {
    std::int64_t a_line = 0;
    std::vector<float> low;   ///< of a run and of the one beside it in the next line; -infinity where a part is bare
    std::vector<float> high;  ///< of a run; -infinity where all is bare
  };
  static constexpr std::int64_t kRun = 4;
  const Runs& eastwards() const { return eastwards_; }
  const Runs& southwards() const { return southwards_; }
  bool holds(RasterGrid::Cell bin) const { return bin.column < columns() && bin.row < rows(); }
  /// A plane that the surface within one bin does not rise above, at a position in bins; grid units.
  double lid(RasterGrid::Cell bin, double column, double row) const {
    const Lid& lid = lids_[grid_.index(bin)];
    return lid.middle + lid.per_column * (column - static_cast<double>(bin.column) - 0.5) +
           lid.per_row * (row - static_cast<double>(bin.row) - 0.5);
  }
  /// Of the surface at a position in metres, metres, where it is there.
  std::optional<double> ground(const Tin& tin, Point2 position) const;
  /// Those that meet the bin, or nearly meet it: kSlack bins away at least.
  std::span<const std::uint32_t> triangles(RasterGrid::Cell bin) const { return bins_.triangles(grid_.index(bin)); }
  static constexpr double kSlack = 1e-7;
  /// Where the surface ends.
  const std::vector<BoundaryEdge>& boundary() const { return boundary_; }
  /// Whether each triangle lies in one bin alone.
  bool partition() const { return lattice_; }
  /// Calls visit(triangles) for each bin about a position in grid units, but for rounding: 1, or up to 4 at its edges.
  /// Ends when visit returns true.
  template <class Visit>
  void find_at(double x, double y, const Visit& visit) const {
    const double column = column_at(x), row = row_at(y);
    const auto at = [](double v, std::int64_t count) {
      return static_cast<std::int64_t>(std::clamp(v, 0.0, static_cast<double>(count - 1)));
    };
    for (std::int64_t r = at(row - kSlack, rows()); r <= at(row + kSlack, rows()); ++r)
      for (std::int64_t c = at(column - kSlack, columns()); c <= at(column + kSlack, columns()); ++c)
        if (visit(triangles({c, r}))) return;
  }
  /// A triangle's highest vertex, grid units.
  std::int32_t top(std::uint32_t triangle) const { return tops_[triangle]; }
  /// Of the surface, grid units.
  double greatest_magnitude() const { return greatest_magnitude_; }

 private:
  BinnedHeights(const Tin& tin, const std::optional<CellLattice>& lattice);

  struct Lid {
    float middle = -std::numeric_limits<float>::infinity();
    float per_column = 0, per_row = 0;
  };
  /// A value a bin.
  struct Ranges {
    std::vector<float> low, high;
  };
  void bound(const Tin& tin, RasterGrid::Cell bin, Ranges& ranges);
  void bound_cell(const CellLattice& lattice, RasterGrid::Cell bin, Ranges& ranges);
  void bound_runs(const Ranges& ranges);
  void forget_depth_at_boundary(const Tin& tin, std::vector<float>& low) const;

  Grid units_;
  RasterGrid grid_;
  TriangleBins bins_;
  std::vector<std::int32_t> tops_;
  std::vector<Lid> lids_;
  Runs eastwards_, southwards_;
  double greatest_magnitude_ = 0;
  bool lattice_;
  std::vector<BoundaryEdge> boundary_;
};

}  // namespace itin::viewshed
