// Which raised theme is under each cell of a raster.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/detail.hpp>
#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>

namespace itin::viewshed {

/// Returns the number of the theme that the surface is part of at each cell's centre, 0 for ground and where there is
/// no surface; where several meet, the first. Precondition: the store has at most 255 themes. Memory follows the
/// raster. Throws CorruptStore, Cancelled.
std::vector<std::uint8_t> theme_raster(const Store& store, const RasterGrid& grid, const Detail& detail,
                                       const ThemeChoice& themes, Progress& progress);

}  // namespace itin::viewshed
