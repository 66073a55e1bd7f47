// Rasters of heights on a store's ground: the features that stand for their cells.
//
// Each patch of cells (cell_patches.hpp) becomes a feature whose top follows the terrain, a whole number of steps above
// it. A height above the ground becomes steps without a look at the ground; an elevation counts from the terrain under
// the middle of a cell. Cells that do not lie wholly on the ground are left out, and reported.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "features/raised_theme.hpp"
#include "store/segments/footprint_codec.hpp"

namespace itin {

struct CellFeatures {
  bool any = false;                         ///< whether there are rasters; else `footprints` is empty
  std::vector<StoredFootprint> footprints;  ///< the footprints that were given, with patches in place of rasters
  std::vector<bool> is_patch;               ///< by footprint
  std::vector<RaisedReport> reports;
};

/// Throws Cancelled, what triangulate() throws, and InputError, which names `height_step` and `height_threshold`, where
/// raising the patches would take more than the memory.
CellFeatures with_patches(const Store& ground, std::span<const StoredFootprint> footprints, std::uint64_t memory_bytes,
                          const Progress& progress);

}  // namespace itin
