// Parts of a visibility index, which may be sampled by anyone in any order, and all of them together.
//
//   const RasterGrid grid = index_grid(store, request);
//   IndexMerge merge(grid);
//   for (const CellRectangle& cells : some_parts_of(grid)) merge.add(index_part(store, request, grid, cells,
//   progress)); const VisibilityIndex index = merge.take();
#pragma once

#include <cstdint>
#include <vector>

#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <viewshed/visibility_index.hpp>

#include "line/cell_tiles.hpp"

namespace itin::viewshed {

/// What VisibilityIndex has of each cell.
struct IndexShares {
  std::vector<float> share, standard_error, undecided;
};

/// What VisibilityIndex counts.
struct IndexCounts {
  bool any_eye = false;  ///< whether some cell's centre lies on ground in the area
  std::uint64_t targets = 0, lines = 0, triangles = 0;
  RetrievalStatistics retrieval;
};

struct IndexPart {
  CellRectangle cells;  ///< which cells of the whole grid it has
  IndexShares shares;   ///< what these have, row by row
  IndexCounts counts = {};
};

/// Returns the cells of the request. Throws InputError for values out of range, and where the memory does not hold the
/// rasters.
RasterGrid index_grid(const Store& store, const IndexRequest& request);

/// Samples the observers of some cells of index_grid(). What a cell's observer sees does not depend on the others.
/// Throws what visibility_index() throws; a part may have no ground.
IndexPart index_part(const Store& store, const IndexRequest& request, const RasterGrid& grid,
                     const CellRectangle& cells, Progress& progress);

class IndexMerge {
 public:
  explicit IndexMerge(const RasterGrid& grid);

  void add(const IndexPart& part);
  /// The whole index. Throws InputError as visibility_index() does where there is no ground.
  VisibilityIndex take();

 private:
  RasterGrid grid_;
  IndexShares shares_;
  IndexCounts counts_;
};

}  // namespace itin::viewshed
