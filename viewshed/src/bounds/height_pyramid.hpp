// Where a surface may rise above sight lines: its triangles in square bins, with the greatest height of every bin and
// of blocks of 2 x 2, 4 x 4, ... bins.
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
#include <vector>

#include <itin/raster.hpp>
#include <itin/tin.hpp>

#include "bounds/triangle_bins.hpp"
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
  /// One line, with its own end.
  explicit LineBundle(const SightLine& line) : end(line.to_z()) { add(line); }

  void add(const SightLine& line) {
    const Point3& from = line.from();
    from_west = std::min(from_west, from.x), from_east = std::max(from_east, from.x);
    from_south = std::min(from_south, from.y), from_north = std::max(from_north, from.y);
    const double x = from.x + line.dx(), y = from.y + line.dy();
    to_west = std::min(to_west, x), to_east = std::max(to_east, x);
    to_south = std::min(to_south, y), to_north = std::max(to_north, y);
    from_z = std::min(from_z, from.z);
    bulge = std::max(bulge, line.bulge());
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
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
};

class HeightPyramid {
 public:
  /// The Tin must outlive it. About 20 bytes a triangle of even size.
  explicit HeightPyramid(const Tin& tin);

  /// Calls visit(triangle) for every triangle that may rise above a line of the bundle, or come within its margin,
  /// nearest first, some more than once. A block is left out as a whole where the lines run above its highest point.
  /// `Lines` is a LineBundle, or what has its members and another lowest_over().
  template <class Lines, class Visit>
  void search(const Lines& bundle, const Visit& visit) const;

  /// A triangle that holds a position in grid units, if there is one.
  std::optional<std::uint32_t> triangle_at(Point2 units) const;

 private:
  struct Block {
    std::uint32_t level = 0;  ///< 2^level bins a side
    std::uint32_t column = 0, row = 0;
  };
  /// Fractions of the lines' lengths.
  struct Stretch {
    double first = 0, last = 1;
    bool empty() const { return first > last; }
    /// Leaves what has a + b s <= c.
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
    /// The stretch within a block, or a hair about it.
    Stretch within(const Block& b) const;
  };

  Track track_of(const LineBundle& bundle) const;
  std::uint32_t side(std::uint32_t level) const { return side_ >> level; }
  std::int32_t highest(const Block& b) const {
    return highest_[b.level][std::size_t{b.row} * side(b.level) + b.column];
  }

  static constexpr std::size_t kMaxLevels = 12;

  const Tin& tin_;
  RasterGrid bin_grid_;
  TriangleBins bins_;
  std::uint32_t side_;
  std::vector<std::int32_t> tops_;                  ///< a triangle
  std::vector<std::vector<std::int32_t>> highest_;  ///< a level, row by row
  Grid grid_;
};

inline HeightPyramid::Stretch HeightPyramid::Track::within(const Block& b) const {
  // Against rounding; less than TriangleBins allows its triangles.
  constexpr double kHair = 1e-7;
  const double size = static_cast<double>(1U << b.level) + 2 * kHair;
  const double x = (b.column << b.level) - kHair, y = (b.row << b.level) - kHair;
  Stretch stretch;
  stretch.limit(west.at, west.per, x + size);
  stretch.limit(-east.at, -east.per, -x);
  stretch.limit(north.at, north.per, y + size);
  stretch.limit(-south.at, -south.per, -y);
  return stretch;
}

template <class Lines, class Visit>
void HeightPyramid::search(const Lines& bundle, const Visit& visit) const {
  const Track track = track_of(bundle);
  // The child nearest to the lines' start, and then across x, y and both.
  const std::uint32_t near = (track.west.per < 0 ? 1U : 0U) | (track.north.per < 0 ? 2U : 0U);
  std::array<Block, 3 * kMaxLevels + 4> pending;
  std::size_t count = 1;
  pending[0] = {static_cast<std::uint32_t>(highest_.size() - 1), 0, 0};
  while (count > 0) {
    const Block block = pending[--count];
    const Stretch stretch = track.within(block);
    if (stretch.empty() || stretch.first > bundle.reach) continue;
    const double lowest = bundle.lowest_over(stretch.first, stretch.last);
    if (highest(block) + bundle.margin <= lowest) continue;
    if (block.level > 0) {
      for (const std::uint32_t across : {3U, 2U, 1U, 0U}) {
        const std::uint32_t child = near ^ across;
        pending[count++] = {block.level - 1, 2 * block.column + (child & 1), 2 * block.row + (child >> 1)};
      }
      continue;
    }
    for (const std::uint32_t t : bins_.triangles(std::size_t{block.row} * side_ + block.column))
      if (tops_[t] + bundle.margin > lowest) visit(t);
  }
}

}  // namespace itin::viewshed
