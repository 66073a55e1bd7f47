// Parts of a visibility index, which may be computed by anyone in any order, and all of them together.
//
//   const IndexLayout layout = lay_out_index(store, request, progress);
//   IndexMerge merge(layout, IndexMerge::Cells::kKept);
//   for (const CellRectangle& cells : some_parts_of(layout.grid))
//     merge.add(index_part(store, request, layout, cells, progress));
//   const VisibilityIndex index = merge.take();
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <viewshed/visibility_index.hpp>

#include "index/index_layout.hpp"
#include "index/share_sum.hpp"
#include "line/cell_tiles.hpp"

namespace itin::viewshed {

/// What VisibilityIndex has of each cell.
struct IndexShares {
  explicit IndexShares(std::size_t cells);

  std::vector<float> share, standard_error, undecided;  ///< NaN where there is no observer
};

/// What VisibilityIndex counts. All are whole numbers, so that the sums of parts do not depend on how the index is
/// divided.
struct IndexCounts {
  bool any_eye = false;  ///< whether some cell's centre lies on ground in the area
  std::uint64_t targets = 0, lines = 0, triangles = 0;
  RetrievalStatistics retrieval;
  /// The looks along each ray, summed over the observers, as RayCourse counts them: those on ground, and those that are
  /// seen. Empty where there are no rays.
  std::vector<std::uint64_t> on_ground_of_ray, seen_of_ray;

  void make_rays(unsigned rays) { on_ground_of_ray.resize(rays), seen_of_ray.resize(rays); }
  IndexCounts& operator+=(const IndexCounts& other);
};

struct IndexPart {
  explicit IndexPart(const CellRectangle& rectangle) : cells(rectangle), shares(rectangle.count()) {}
  /// The number of a cell of the whole grid among these cells.
  std::size_t number(RasterGrid::Cell cell) const {
    return static_cast<std::size_t>((cell.row - cells.row) * cells.columns + cell.column - cells.column);
  }

  CellRectangle cells;  ///< which cells of the whole grid it has
  IndexShares shares;   ///< what these have, row by row
  IndexCounts counts = {};
};

/// Looks from some cells of the layout's grid. What a cell's observer sees does not depend on the others. Throws what
/// visibility_index() throws; a part may have no ground.
IndexPart index_part(const Store& store, const IndexRequest& request, const IndexLayout& layout,
                     const CellRectangle& cells, Progress& progress);

/// What all cells have together.
struct IndexSums {
  std::uint64_t observers = 0;
  ShareSum share, undecided, variance;

  void add(const IndexShares& shares);
};

class IndexMerge {
 public:
  enum class Cells { kKept, kLeftOut };

  IndexMerge(IndexLayout layout, Cells cells);

  void add(const IndexPart& part);
  /// Returns the whole index, with its cells where they were kept. Throws InputError as visibility_index() does where
  /// there is no ground.
  VisibilityIndex take();

 private:
  IndexLayout layout_;
  std::optional<IndexShares> shares_;  ///< nothing: left out
  IndexSums sums_;
  IndexCounts counts_;
};

}  // namespace itin::viewshed
