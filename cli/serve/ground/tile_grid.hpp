// The grid of the tiles that pictures of the ground are made of.
//
//   const TileGrid grid = tile_grid(metadata);
//   const std::optional<Box> box = grid.box({.zoom = 3, .column = 1, .row = 0});
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/store.hpp>

namespace itin::cli {

inline constexpr int kTilePixels = 256;

struct TileAddress {
  int zoom = 0, column = 0, row = 0;
};

/// Reads "3/1/0"; nothing for anything else.
std::optional<TileAddress> tile_address(const std::string& text);

struct TileGrid {
  Point2 origin;                    ///< the north-west corner of tile 0/0/0
  std::vector<double> resolutions;  ///< metres a pixel: powers of 2, the coarsest first
  Box data;                         ///< beyond it there are no tiles

  /// What a tile covers; nothing for one that is not over the data.
  std::optional<Box> box(const TileAddress& tile) const;
};

/// From one tile over all data, or four, down to pixels of half the spacing of the finest source.
TileGrid tile_grid(const StoreMetadata& metadata);

}  // namespace itin::cli
