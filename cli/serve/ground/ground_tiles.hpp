// Tiles of the ground: its heights, and the outlines of what stands on it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/progress.hpp>

#include "serve/ground/served_store.hpp"
#include "serve/ground/tile_grid.hpp"

namespace itin::cli {

/// Pixels around a tile of heights that belong to its neighbours, for slopes at its edges.
inline constexpr int kTileBorder = 1;

/// Returns the heights in the middle of pixels, as float32 row by row from the north-west, border included; NaN where
/// there is no ground. Where pixels are larger than the spacing of the data, the surface is thinned. Nothing where
/// there is no tile. Throws what heights_at() throws.
std::optional<std::string> height_tile(const ServedStore& served, const TileGrid& grid, const TileAddress& tile,
                                       Progress& progress);

/// The themes that have tiles of outlines.
std::vector<std::string> outlined_themes(const StoreMetadata& metadata);
/// Returns {"rings": [[x, y, ...], ...]} of a theme's buildings that meet the tile. Nothing where there is no tile.
/// Precondition: the theme is one of these. Throws what building_outlines() throws.
std::optional<std::string> outline_tile(const ServedStore& served, const TileGrid& grid, const TileAddress& tile,
                                        const std::string& theme);

}  // namespace itin::cli
