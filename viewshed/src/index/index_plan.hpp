// A visibility index cut into blocks of cells, so that the ground that their observers may see fits into the memory.
//
//   for (const IndexSegment& segment : index_segments(store, request, grid, all_cells(grid), fits)) ...
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <itin/window.hpp>
#include <viewshed/visibility_index.hpp>

#include "line/cell_tiles.hpp"

namespace itin::viewshed {

struct IndexSegment {
  CellRectangle cells;
  Window window;         ///< holds every sight line of their observers
  std::uint64_t points;  ///< about how many points of the surface it holds
};

/// Tells whether a segment's surface fits into the memory, beside what it takes to decide its sight lines.
using SurfaceFits = std::function<bool(const IndexSegment& segment)>;

/// Takes the cells that lie in the area, halved until the ground about each block fits. Throws InputError where the
/// ground about a single observer does not.
std::vector<IndexSegment> index_segments(const Store& store, const IndexRequest& request, const RasterGrid& grid,
                                         const CellRectangle& cells, const SurfaceFits& fits);

}  // namespace itin::viewshed
