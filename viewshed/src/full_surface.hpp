// The full surface in memory, and what an eye sees of what stands on it: exact, cell for cell, and without a tree of
// triangles for rays.
//
//   const FullSurface surface(std::move(tin), std::nullopt, request.earth, grid, tiles);
//   FullSurface::Work work;
//   surface.judge(eye, tile, values, work);   // every kUndecided cell becomes visible, hidden or outside
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <itin/earth.hpp>
#include <itin/raster.hpp>
#include <itin/tin.hpp>
#include <viewshed/certified.hpp>

#include "axis_sweep.hpp"
#include "binned_heights.hpp"
#include "eye.hpp"
#include "surface_heights.hpp"
#include "triangle_bins.hpp"

namespace itin::viewshed {

class FullSurface {
 public:
  /// `surface` hides; targets stand on it, or on `bare_ground` where that is given. `tiles` are those of `grid`, and
  /// both must outlive this.
  FullSurface(Tin surface, std::optional<Tin> bare_ground, const Earth& earth, const RasterGrid& grid,
              const RasterGrid& tiles);
  FullSurface(const FullSurface&) = delete;
  FullSurface& operator=(const FullSurface&) = delete;

  const Tin& tin() const { return tin_; }
  /// Where it ends.
  const std::vector<BoundaryEdge>& boundary() const { return heights_.boundary(); }
  /// Leaves nothing to judge by.
  Tin release() && { return std::move(tin_); }

  /// Memory to use again, of one thread.
  struct Work {
    TileValues<double> ground, targets;  ///< grid units
    AxisSweep::Heights seen;
    AxisSweep::Scratch scratch;
  };
  /// kUndecided cells become kCertainlyVisible, kCertainlyHidden, or kOutside where there is no ground or the eye does
  /// not look. Returns how many sight lines that took.
  std::uint64_t judge(const Eye& eye, std::size_t tile, TileValues<std::uint8_t>& values, Work& work) const;

 private:
  void raise_targets(const Eye& eye, const Tile& tile, const TileCentres& centres, TileValues<std::uint8_t>& values,
                     Work& work) const;
  void find_ground(std::size_t index, const Tile& tile, const TileCentres& centres, Work& work) const;

  Tin tin_;
  std::optional<Tin> bare_ground_;
  const RasterGrid& grid_;
  const RasterGrid& tiles_;
  BinnedHeights heights_;
  std::optional<TriangleBins> of_tiles_;  ///< of what targets stand on, where `heights_` does not tell it well
  AxisSweep sweep_;
};

}  // namespace itin::viewshed
