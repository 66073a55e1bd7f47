// Where a surface may rise above a sight line: its triangles in square bins, with the greatest height of every bin and
// of blocks of 2 x 2, 4 x 4, ... bins.
//
//   HeightPyramid pyramid(tin);
//   double end = ...;                                         // height of the line's far end, grid units
//   pyramid.search(line, end, [&](std::uint32_t triangle) { end = std::max(end, ...); });
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <itin/raster.hpp>
#include <itin/tin.hpp>

#include "sight_line.hpp"
#include "triangle_bins.hpp"

namespace itin::viewshed {

class HeightPyramid {
 public:
  /// The Tin must outlive it. About 15 bytes a triangle of even size.
  explicit HeightPyramid(const Tin& tin);

  /// Calls visit(triangle) for every triangle that may rise above `line` with its end `to` at the height `end`, nearest
  /// first, some more than once; a visit may raise `end`, which leaves out more of what follows. A block is left out as
  /// a whole where the line runs above its highest point.
  template <class Visit>
  void search(const SightLine& line, const double& end, const Visit& visit) const;

 private:
  struct Block {
    std::uint32_t level = 0;  ///< 2^level bins a side
    std::uint32_t column = 0, row = 0;
  };
  /// Fractions of a line's length.
  struct Stretch {
    double first = 0, last = 1;
    bool empty() const { return first > last; }
  };
  /// A line in units of bins.
  struct Track {
    double x, y, per_dx, per_dy;
    /// The stretch within a block, or a hair about it.
    Stretch within(const Block& b) const;
  };

  Track track_of(const SightLine& line) const;
  std::uint32_t side(std::uint32_t level) const { return side_ >> level; }
  std::int32_t highest(const Block& b) const {
    return highest_[b.level][std::size_t{b.row} * side(b.level) + b.column];
  }
  std::int32_t highest(const Triangle& t) const {
    return std::max({tin_.vertices[t[0]].z, tin_.vertices[t[1]].z, tin_.vertices[t[2]].z});
  }

  static constexpr std::size_t kMaxLevels = 12;

  const Tin& tin_;
  RasterGrid bin_grid_;
  TriangleBins bins_;
  std::uint32_t side_;
  std::vector<std::vector<std::int32_t>> highest_;  ///< a level, row by row
};

inline HeightPyramid::Stretch HeightPyramid::Track::within(const Block& b) const {
  // Against rounding; less than TriangleBins allows its triangles.
  constexpr double kHair = 1e-7;
  const double size = static_cast<double>(1U << b.level) + 2 * kHair;
  const double west = (b.column << b.level) - kHair - x, north = (b.row << b.level) - kHair - y;
  const double x0 = west * per_dx, x1 = (west + size) * per_dx, y0 = north * per_dy, y1 = (north + size) * per_dy;
  return {std::max({0.0, std::min(x0, x1), std::min(y0, y1)}), std::min({1.0, std::max(x0, x1), std::max(y0, y1)})};
}

template <class Visit>
void HeightPyramid::search(const SightLine& line, const double& end, const Visit& visit) const {
  const Track track = track_of(line);
  // The child nearest to the line's start, and then across x, y and both.
  const std::uint32_t near = (track.per_dx < 0 ? 1U : 0U) | (track.per_dy < 0 ? 2U : 0U);
  std::array<Block, 3 * kMaxLevels + 4> pending;
  std::size_t count = 1;
  pending[0] = {static_cast<std::uint32_t>(highest_.size() - 1), 0, 0};
  while (count > 0) {
    const Block block = pending[--count];
    const Stretch stretch = track.within(block);
    if (stretch.empty()) continue;
    const double lowest = line.lowest_over(stretch.first, stretch.last, end);
    if (highest(block) <= lowest) continue;
    if (block.level > 0) {
      for (const std::uint32_t across : {3U, 2U, 1U, 0U}) {
        const std::uint32_t child = near ^ across;
        pending[count++] = {block.level - 1, 2 * block.column + (child & 1), 2 * block.row + (child >> 1)};
      }
      continue;
    }
    for (const std::uint32_t t : bins_.triangles(std::size_t{block.row} * side_ + block.column))
      if (highest(tin_.triangles[t]) > lowest) visit(t);
  }
}

}  // namespace itin::viewshed
