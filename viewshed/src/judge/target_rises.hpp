// How far targets rise above the bare surface, box of cells by box of cells: where they stand on features, by as much
// as these are high.
//
//   const TargetRises rises(store, request, grid);
//   rises.over(tile, all_of(tile))   // grid units
#pragma once

#include <cstdint>
#include <vector>

#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <viewshed/request.hpp>

#include "bounds/cell_blocks.hpp"

namespace itin::viewshed {

class TargetRises {
 public:
  /// Lets no target rise.
  TargetRises() = default;
  /// Cost: for each tile that has features, 64 look-ups of the store's directory per theme.
  TargetRises(const Store& store, const Request& request, const RasterGrid& grid);

  /// The greatest rise in a block of a tile's cells, grid units.
  double over(const Tile& tile, const CellBlock& block) const;

 private:
  static constexpr std::int64_t kSide = 8;  ///< cells, of a box
  static_assert(Tile::kSide % kSide == 0);

  void raise(const Store& store, const ThemeChoice& themes, const RasterGrid& grid, const Tile& tile);

  std::int64_t columns_ = 0;   ///< boxes
  std::vector<double> rises_;  ///< one for each box; empty where no target rises
};

}  // namespace itin::viewshed
