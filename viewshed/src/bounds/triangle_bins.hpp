// Which triangles of a Tin may touch which cell of a coarse grid.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/tin.hpp>

namespace itin::viewshed {

/// Square bins over the whole Tin, `side` along each side.
RasterGrid square_bins_over(const Tin& tin, double side);
/// About as many bins over a Tin as it has triangles, so that a few lie in each.
RasterGrid location_grid(const Tin& tin);

class TriangleBins {
 public:
  /// Lists a triangle in every cell of `grid` that it meets, or nearly meets, by ascending number. O(n) plus the
  /// entries. Throws std::length_error for 2^32 entries and more, and Cancelled.
  TriangleBins(const Tin& tin, const RasterGrid& grid, const Progress& progress = NoProgress());

  std::span<const std::uint32_t> triangles(std::size_t bin) const {
    return std::span(triangles_).subspan(first_[bin], first_[bin + 1] - first_[bin]);
  }

 private:
  std::vector<std::uint32_t> first_;  ///< bin b has triangles_[first_[b], first_[b + 1])
  std::vector<std::uint32_t> triangles_;
};

}  // namespace itin::viewshed
