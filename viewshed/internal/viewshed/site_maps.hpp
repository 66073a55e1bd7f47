// What maps of a choice of sites are drawn on.
#pragma once

#include <cstdint>

#include <itin/level_choice.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>

namespace itin::viewshed {

/// Returns the level whose hillshade lies under maps of these cells.
inline int hillshade_level(const Store& store, const RasterGrid& grid) {
  constexpr std::uint64_t kHillshadePoints = 400000;
  return finest_level_of(store, grid.bounds(), kHillshadePoints);
}

}  // namespace itin::viewshed
