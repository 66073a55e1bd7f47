// How low and how high a surface is within bins; and within far smaller parts where a thin thing stands on it that no
// bin lies wholly upon, such as a garden wall. So houses and walls alike certainly hide, though bins are as wide as a
// wall is high. A surface that the memory does not hold at once is added piece by piece.
//
//   SurfaceBins bins(tin.grid, box, side);
//   bins.add(tin, all_cells(bins.tiles()));
//   bins.range(bin).low                                // grid units
//   if (const SurfaceBins::Parts* parts = bins.parts(bin)) ...
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <itin/tin.hpp>

#include "bounds/bin_bounds.hpp"
#include "bounds/boundary.hpp"
#include "line/cell_tiles.hpp"

namespace itin::viewshed {

class SurfaceBins final : public BinGrid {
 public:
  using Range = RunBounds::Range<float>;
  static constexpr std::int64_t kParts = 8;  ///< along the side of a bin that is divided
  using Parts = std::array<Range, kParts * kParts>;

  static constexpr std::uint64_t kBytesPerBin = 12, kBytesPerDivided = sizeof(Parts);

  /// Square bins of this side over a box, metres. At most `most_divided` of them are divided into parts.
  SurfaceBins(const Grid& units, const Box& box, double side, std::size_t most_divided);

  /// Tiles of bins (line/cell_tiles.hpp), as the cells of a grid.
  RasterGrid tiles() const { return grid_of_tiles(grid_); }
  /// Bounds the bins of these tiles, by a surface that holds all ground that meets them. Each tile is added once.
  void add(const Tin& surface, const CellRectangle& tiles);

  /// The heights within a bin: -infinity to -infinity where there is no ground, and from -infinity where there may be
  /// none. They include what is a tenth of a millimetre above or below the surface.
  const Range& range(RasterGrid::Cell bin) const { return ranges_[grid_.index(bin)]; }
  /// The parts of a bin, row by row; null where it is not divided.
  const Parts* parts(RasterGrid::Cell bin) const {
    const std::uint32_t number = divided_[grid_.index(bin)];
    return number == 0 ? nullptr : &parts_[number - 1];
  }

 private:
  bool is_thin(RasterGrid::Cell bin) const;
  void bound(const Tin& surface, std::span<const std::uint32_t> triangles, const Tile& tile);
  void forget_depth_along(const std::vector<BoundaryEdge>& outline, const Tin& surface, const CellRectangle& bins);
  void divide(const Tin& surface, std::span<const std::uint32_t> triangles, const Tile& tile);

  std::size_t most_divided_;
  std::vector<Range> ranges_;
  std::vector<std::uint32_t> divided_;  ///< by bin: one more than where its parts are; 0 where it has none
  std::vector<Parts> parts_;
};

}  // namespace itin::viewshed
