// The height of the ground under targets.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/raster.hpp>
#include <itin/tin.hpp>

#include "line/cell_tiles.hpp"

namespace itin::viewshed {

/// Calls visit(tile, heights) for each tile of the cells that the ground meets, on all threads; heights at cell centres
/// are in grid units, kNoSurface where there is no ground.
void for_each_tile_on(const Tin& ground, const RasterGrid& cells,
                      const std::function<void(const Tile& tile, const TileValues<double>& heights)>& visit);

/// Calls visit(point, height) for each of the points that has ground; grid units.
void for_each_point_on(const Tin& ground, const std::vector<Point2>& points,
                       const std::function<void(std::size_t point, double height)>& visit);

}  // namespace itin::viewshed
