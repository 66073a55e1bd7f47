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

namespace itin::viewshed {

struct CellBlock {
  std::int64_t column = 0, row = 0;  ///< of its north-west cell
  std::int64_t columns = 0, rows = 0;

  std::uint64_t count() const { return static_cast<std::uint64_t>(columns * rows); }
  RasterGrid::Cell cell(std::size_t i) const {
    const auto n = static_cast<std::int64_t>(i);
    return {column + n % columns, row + n / columns};
  }
};

inline CellBlock all_cells(const RasterGrid& grid) {
  return {0, 0, grid.columns(), grid.rows()};
}

struct IndexSegment {
  CellBlock cells;
  Window window;  ///< holds every sight line of their observers
};

/// Whether a surface of about so many points fits, over which so many lines are asked about.
using SurfaceFits = std::function<bool(std::uint64_t points, std::uint64_t lines)>;

/// Takes the cells that lie in the area, halved until the ground about each block fits. Throws InputError where the
/// ground about a single observer does not.
std::vector<IndexSegment> index_segments(const Store& store, const IndexRequest& request, const RasterGrid& grid,
                                         const CellBlock& cells, const SurfaceFits& fits);

}  // namespace itin::viewshed
