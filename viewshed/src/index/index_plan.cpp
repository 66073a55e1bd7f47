#include "index/index_plan.hpp"

#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/level_choice.hpp>

#include "plan/partition.hpp"

namespace itin::viewshed {

namespace {

class IndexPlan {
 public:
  IndexPlan(const Store& store, const IndexRequest& request, const RasterGrid& grid, const SurfaceFits& fits)
      : store_(store),
        request_(request),
        grid_(grid),
        fits_(fits),
        level_(level_within(store.metadata(), request.detail.coarsest())),
        margin_(2 * store.metadata().grid.resolution) {}

  std::vector<IndexSegment> divide(const CellRectangle& cells) const {
    std::vector<IndexSegment> segments;
    for (const Block& block : parts_that_fit(
             Block{cells, {}, 0}, [&](Block& b) { return fits(b); }, [&](const Block& b) { return cut(b); }))
      if (!block.ground.empty()) segments.push_back(segment_of(block));
    return segments;
  }

 private:
  struct Block {
    CellRectangle cells;
    Box ground;                ///< under the sight lines of the observers in the area; empty where there are none
    std::uint64_t points = 0;  ///< how many points that ground has
  };

  static IndexSegment segment_of(const Block& block) { return {block.cells, Window::box(block.ground), block.points}; }

  bool fits(Block& block) const {
    const Box eyes = eyes_of(block.cells);
    if (eyes.empty()) return true;
    const double reach = request_.radius + margin_;
    block.ground = {eyes.xmin - reach, eyes.ymin - reach, eyes.xmax + reach, eyes.ymax + reach};
    block.points = store_.points_about(level_, block.ground);
    return fits_(segment_of(block));
  }

  std::pair<Block, Block> cut(const Block& block) const {
    if (block.cells.count() > 1) {
      const auto [first, rest] = halves(block.cells);
      return {{first, {}, 0}, {rest, {}, 0}};
    }
    throw InputError(
        fmt::format("the ground about a single observer has some {} points, more than the memory holds: give a "
                    "smaller `radius`, a coarser `tolerance`, or more `memory_bytes` than {}",
                    block.points, request_.memory_bytes),
        "memory_bytes");
  }

  /// The box about the cells' centres that lie in the area.
  Box eyes_of(const CellRectangle& cells) const {
    Box box;
    for (std::size_t i = 0; i < cells.count(); ++i) {
      const RasterGrid::Cell cell = cells.cell(i);
      const Point2 centre = grid_.centre(cell.column, cell.row);
      if (request_.area.contains(centre)) box.extend(centre);
    }
    return box;
  }

  const Store& store_;
  const IndexRequest& request_;
  const RasterGrid& grid_;
  const SurfaceFits& fits_;
  int level_;
  double margin_;  ///< metres, against rounding
};

}  // namespace

std::vector<IndexSegment> index_segments(const Store& store, const IndexRequest& request, const RasterGrid& grid,
                                         const CellRectangle& cells, const SurfaceFits& fits) {
  return IndexPlan(store, request, grid, fits).divide(cells);
}

}  // namespace itin::viewshed
