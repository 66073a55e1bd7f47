// The heights of a surface in memory at the centres of cells, kept between one viewshed and the next.
//
//   const KeptGround ground(heights, &tin, cache);
//   ground.find(grid, tile, TileCentres(units, grid, tile), heights_of_cells);
//
// Tiles of 64 by 64 cells are kept, on edges that are multiples of their size, so that viewsheds share them however
// their rasters lie. Cells whose centres are not exactly those of such a tile, for one since their size has no exact
// binary form, are measured anew each time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <itin/raster.hpp>
#include <itin/tin.hpp>

#include "bounds/binned_heights.hpp"
#include "bounds/triangle_bins.hpp"
#include "line/cell_tiles.hpp"
#include "scene/ground_cache.hpp"

namespace itin::viewshed {

/// Safe for concurrent use.
class KeptGround {
 public:
  /// Keeps the ground of a surface whose heights have been binned. `surface` is null where they are a lattice's.
  KeptGround(std::shared_ptr<const BinnedHeights> heights, const Tin* surface, std::shared_ptr<GroundCache> cache);
  /// Keeps the ground of a surface whose heights have not been.
  KeptGround(const Tin& surface, std::shared_ptr<GroundCache> cache);

  /// Finds the heights at a tile's centres, grid units; kNoSurface where no ground is.
  void find(const RasterGrid& grid, const Tile& tile, const TileCentres& at, TileValues<double>& ground) const;

 private:
  struct Bins {
    explicit Bins(const Tin& tin) : grid(location_grid(tin)), triangles(tin, grid) {}
    RasterGrid grid;
    TriangleBins triangles;
  };
  /// Cells of the tile that is looked at which lie in one that is kept.
  struct Share {
    GroundCache::Key key;
    std::int64_t column = 0, row = 0;            ///< where the first is in the tile looked at
    std::int64_t kept_column = 0, kept_row = 0;  ///< and in the kept one
    std::int64_t columns = 0, rows = 0;
  };
  std::vector<Share> shares(const RasterGrid& grid, const Tile& tile) const;
  bool holds_centres(const Share& share, const TileCentres& at) const;
  GroundCache::Heights kept(const GroundCache::Key& key) const;
  void measure(const Tile& tile, const TileCentres& at, double cell_width, TileValues<double>& ground) const;
  std::optional<double> height_at(Point2 units) const;
  std::vector<std::uint32_t> triangles_about(const Tile& tile, const TileCentres& at) const;

  const std::shared_ptr<const BinnedHeights> heights_;  ///< null: `bins_` are there
  const Tin* surface_;
  std::optional<Bins> bins_;
  const Grid units_;
  double bin_side_;  ///< metres
  const std::shared_ptr<GroundCache> cache_;
  const std::uint64_t number_;  ///< in the cache
};

}  // namespace itin::viewshed
