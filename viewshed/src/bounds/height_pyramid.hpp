// Finds where a surface may rise above sight lines: its triangles in square bins, with the greatest height of every bin
// and of blocks of 2 x 2, 4 x 4, ... bins. A lattice's bins are its cells.
//
//   HeightPyramid pyramid(tin);
//   LineBundle bundle;
//   for (const SightLine& line : lines) bundle.add(line);
//   bundle.end = ...;                                       // the lowest far end of all, grid units
//   pyramid.search(bundle, [&](std::uint32_t triangle) { ... });
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <itin/lattice_tin.hpp>
#include <itin/raster.hpp>
#include <itin/tin.hpp>

#include "bounds/triangle_bins.hpp"
#include "line/infinity.hpp"
#include "line/sight_line.hpp"

namespace itin::viewshed {

/// Lines close together: a box of their near ends, a box of their far ends, and a height below all of them. At the
/// fraction s of their lengths they lie in the box between the two, and above
/// (1 - s) from_z + s end - bulge s (1 - s), measured so that curved ground is flat.
struct LineBundle {
  double from_west = kInfinity, from_east = -kInfinity, from_south = kInfinity, from_north = -kInfinity;
  double to_west = kInfinity, to_east = -kInfinity, to_south = kInfinity, to_north = -kInfinity;
  double from_z = kInfinity;
  double bulge = 0;
  // These may change during a search, and leave out more of what follows:
  double end = 0;     ///< height of the lowest far end
  double reach = 1;   ///< the fraction of the lengths up to which the lines matter
  double margin = 0;  ///< how far below the lines ground matters, too

  LineBundle() = default;
  /// A bundle of one line, with its own end.
  explicit LineBundle(const SightLine& line) : end(line.to_z()) { add(line); }

  void add(const SightLine& line) {
    const Point3& from = line.from();
    from_west = std::min(from_west, from.x), from_east = std::max(from_east, from.x);
    from_south = std::min(from_south, from.y), from_north = std::max(from_north, from.y);
    const double x = from.x + line.dx(), y = from.y + line.dy();
    to_west = std::min(to_west, x), to_east = std::max(to_east, x);
    to_south = std::min(to_south, y), to_north = std::max(to_north, y);
    from_z = std::min(from_z, from.z);
    bulge = std::max(bulge, line.bulge().drop);
  }
  /// Lowest height over the fractions [first, last].
  double lowest_over(double first, double last) const {
    const double dz = end - from_z;
    const auto height = [&](double s) { return from_z + s * (dz - bulge * (1 - s)); };
    double result = std::min(height(first), height(last));
    if (bulge > 0) result = std::min(result, height(std::clamp(0.5 - dz / (2 * bulge), first, last)));
    return result;
  }

 private:
};

class HeightPyramid {
 public:
  /// The surface must outlive this object. Takes about 20 bytes per triangle of even size. Throws Cancelled.
  explicit HeightPyramid(const Tin& tin, const Progress& progress = NoProgress());
  /// All heights of the lattice must have been read. Takes less than two bytes per post.
  explicit HeightPyramid(const LatticeTin& lattice);

  const Grid& units() const { return units_; }
  /// The surface, where it is a Tin.
  const Tin& tin() const { return *tin_; }

  /// Calls visit(triangle) for every triangle that may rise above a line of the bundle, or come within its margin,
  /// nearest first, some more than once. A block is left out as a whole where the lines run above its highest point.
  /// `Lines` is a LineBundle, or a type that has its members and another lowest_over().
  template <class Lines, class Visit>
  void search(const Lines& bundle, const Visit& visit) const;

  std::array<GridPoint, 3> corners(std::uint32_t triangle) const {
    return lattice_ != nullptr ? lattice_->corners(triangle) : tin_->corners(triangle);
  }
  /// Calls visit(triangle) for the triangles near a position in grid units, among them all that hold it, until one call
  /// returns false; returns whether none did.
  template <class Visit>
  bool for_each_triangle_near(Point2 units, const Visit& visit) const;
  /// A triangle that holds a position in grid units, if there is one.
  std::optional<std::uint32_t> triangle_at(Point2 units) const;
  /// The surface's height at a position, both in grid units.
  std::optional<double> height_at(Point2 units) const;

 private:
  static constexpr double kHair = 1e-7;  ///< bins, against rounding; less than TriangleBins allows its triangles

  struct Block {
    std::uint32_t level = 0;  ///< 2^level bins per side
    std::uint32_t column = 0, row = 0;
  };
  /// Fractions of the lines' lengths.
  struct Stretch {
    double first = 0, last = 1;
    bool empty() const { return first > last; }
    Stretch operator&(const Stretch& other) const { return {std::max(first, other.first), std::min(last, other.last)}; }
    /// Keeps only the fractions s that have a + b s <= c; `per_b` is 1 / b.
    void limit(double a, double per_b, double c) {
      const double s = (c - a) * per_b;
      if (per_b > 0) last = std::min(last, s);
      if (per_b < 0) first = std::max(first, s);
    }
  };
  /// One side of a bundle, in bins: at the fraction s it is at `at + s / per`.
  struct Side {
    double at = 0, per = 0;
  };
  struct Track {
    Side west, east, north, south;
    /// The stretches between columns, or rows, or a hair about them.
    Stretch across(double first, double last) const { return between(west, east, first, last); }
    Stretch down(double first, double last) const { return between(north, south, first, last); }

   private:
    static Stretch between(const Side& low, const Side& high, double first, double last) {
      Stretch stretch;
      stretch.limit(low.at, low.per, last + kHair);
      stretch.limit(-high.at, -high.per, kHair - first);
      return stretch;
    }
  };
  struct Pending {
    Block block;
    Stretch stretch;  ///< within the block
  };

  /// These are computed once for a Tin.
  struct Listed {
    TriangleBins bins;
    std::vector<std::int32_t> tops;  ///< per triangle
  };

  void build_blocks();
  Track track_of(const LineBundle& bundle) const;
  static std::uint32_t blocks(std::int64_t bins, std::uint32_t level) {
    return static_cast<std::uint32_t>((bins + (std::int64_t{1} << level) - 1) >> level);
  }
  std::uint32_t columns(std::uint32_t level) const { return blocks(bin_grid_.columns(), level); }
  std::uint32_t rows(std::uint32_t level) const { return blocks(bin_grid_.rows(), level); }
  std::int32_t highest(const Block& b) const {
    if (b.level == 0 && lattice_ != nullptr) return highest_of_cell(lattice_->cell(b.column, b.row));
    return highest_[b.level][std::size_t{b.row} * columns(b.level) + b.column];
  }
  std::int32_t highest_of_cell(std::uint32_t cell) const;
  /// Calls visit(triangle) until one call returns false, and returns whether none did.
  template <class Visit>
  bool for_each_triangle(const Block& bin, const Visit& visit) const;
  struct Hit {
    std::uint32_t triangle;
    double height;
  };
  std::optional<Hit> hit_at(Point2 units) const;

  static constexpr std::int32_t kNothing = std::numeric_limits<std::int32_t>::min();
  static constexpr std::size_t kMaxLevels = 32;

  const Tin* tin_ = nullptr;
  const LatticeTin* lattice_ = nullptr;  ///< else it is the Tin
  Grid units_;
  RasterGrid bin_grid_;
  std::optional<Listed> listed_;
  std::vector<std::vector<std::int32_t>> highest_;  ///< per level, row by row; a lattice's cells tell their own
};

/// Triangles that a search visited lately: most lie in several bins, and so come again.
class RecentTriangles {
 public:
  RecentTriangles() { triangles_.fill(std::numeric_limits<std::uint32_t>::max()); }
  /// Tells whether an earlier call for this triangle is remembered; some are forgotten.
  bool seen(std::uint32_t triangle) {
    return std::exchange(triangles_[triangle % triangles_.size()], triangle) == triangle;
  }

 private:
  std::array<std::uint32_t, 256> triangles_;
};

inline std::int32_t HeightPyramid::highest_of_cell(std::uint32_t cell) const {
  if (!lattice_->read(cell) || lattice_->halves(cell) == 0) return kNothing;
  const std::int32_t* const upper = lattice_->posts(cell);
  const std::int32_t* const lower = upper + LatticeTin::kPosts;
  return std::max(std::max(upper[0], upper[1]), std::max(lower[0], lower[1]));
}

template <class Lines, class Visit>
void HeightPyramid::search(const Lines& bundle, const Visit& visit) const {
  const Track track = track_of(bundle);
  // The child nearest to the lines' start, and then across x, y and both.
  const std::uint32_t near = (track.west.per < 0 ? 1U : 0U) | (track.north.per < 0 ? 2U : 0U);
  std::array<Pending, 3 * kMaxLevels + 4> pending;
  std::size_t count = 1;
  pending[0] = {{static_cast<std::uint32_t>(highest_.size() - 1), 0, 0}, {0, 1}};
  while (count > 0) {
    const auto [block, stretch] = pending[--count];
    if (stretch.first > bundle.reach) continue;
    const double lowest = bundle.lowest_over(stretch.first, stretch.last);
    if (highest(block) + bundle.margin <= lowest) continue;
    if (block.level > 0) {
      const std::uint32_t level = block.level - 1, columns = this->columns(level), rows = this->rows(level);
      const double side = 1U << level, west = 2 * side * block.column, north = 2 * side * block.row;
      const std::array across{track.across(west, west + side), track.across(west + side, west + 2 * side)};
      const std::array down{track.down(north, north + side), track.down(north + side, north + 2 * side)};
      for (const std::uint32_t other : {3U, 2U, 1U, 0U}) {
        const std::uint32_t child = near ^ other, c = child & 1, r = child >> 1;
        const Block inner{level, 2 * block.column + c, 2 * block.row + r};
        const Stretch within = across[c] & down[r];
        if (!within.empty() && inner.column < columns && inner.row < rows) pending[count++] = {inner, within};
      }
      continue;
    }
    for_each_triangle(block, [&](std::uint32_t t) {
      if (lattice_ != nullptr || listed_->tops[t] + bundle.margin > lowest) visit(t);
      return true;
    });
  }
}

template <class Visit>
bool HeightPyramid::for_each_triangle_near(Point2 units, const Visit& visit) const {
  const double column = bin_grid_.column_at(units_.origin.x + units.x * units_.resolution),
               row = bin_grid_.row_at(units_.origin.y + units.y * units_.resolution);
  const auto at = [](double v, std::int64_t count) {
    return static_cast<std::uint32_t>(std::clamp(v, 0.0, static_cast<double>(count - 1)));
  };
  // Visits one bin, or up to four at the edges of a lattice's bins, which know nothing of their neighbours.
  const double slack = lattice_ != nullptr ? kHair : 0;
  const std::uint32_t east = at(column + slack, bin_grid_.columns()), south = at(row + slack, bin_grid_.rows());
  for (std::uint32_t r = at(row - slack, bin_grid_.rows()); r <= south; ++r)
    for (std::uint32_t c = at(column - slack, bin_grid_.columns()); c <= east; ++c)
      if (!for_each_triangle({0, c, r}, visit)) return false;
  return true;
}

template <class Visit>
bool HeightPyramid::for_each_triangle(const Block& bin, const Visit& visit) const {
  if (lattice_ != nullptr) {
    const std::uint32_t cell = lattice_->cell(bin.column, bin.row);
    return !lattice_->read(cell) || lattice_->for_each_triangle(cell, visit);
  }
  const auto listed = listed_->bins.triangles(std::size_t{bin.row} * columns(0) + bin.column);
  return std::all_of(listed.begin(), listed.end(), visit);
}

}  // namespace itin::viewshed
