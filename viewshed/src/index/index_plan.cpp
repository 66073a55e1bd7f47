#include "index/index_plan.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/level_choice.hpp>
#include <viewshed/site_proposal.hpp>

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

  void divide(const CellBlock& cells, std::vector<IndexSegment>& segments) const {
    const Box eyes = eyes_of(cells);
    if (eyes.empty()) return;
    const double reach = request_.radius + margin_;
    const Box box{eyes.xmin - reach, eyes.ymin - reach, eyes.xmax + reach, eyes.ymax + reach};
    const std::uint64_t points = store_.points_about(level_, box);
    if (fits_(points, cells.count() * request_.targets)) {
      segments.push_back({cells, Window::box(box)});
    } else if (cells.count() > 1) {
      const bool wide = static_cast<double>(cells.columns) * grid_.cell_width() >=
                        static_cast<double>(cells.rows) * grid_.cell_height();
      const bool across = wide ? cells.columns > 1 : cells.rows == 1;
      CellBlock first = cells, rest = cells;
      if (across) {
        first.columns /= 2;
        rest.column += first.columns, rest.columns -= first.columns;
      } else {
        first.rows /= 2;
        rest.row += first.rows, rest.rows -= first.rows;
      }
      divide(first, segments);
      divide(rest, segments);
    } else {
      throw InputError(
          fmt::format("the ground about a single observer has some {} points, more than the memory holds: give a "
                      "smaller `radius`, a "
                      "coarser `tolerance`, or more `memory_bytes` than {}",
                      points, request_.memory_bytes));
    }
  }

 private:
  /// About the centres in the area.
  Box eyes_of(const CellBlock& cells) const {
    Box box;
    for (std::size_t i = 0; i < cells.count(); ++i) {
      const RasterGrid::Cell cell = cells.cell(i);
      const Point2 centre = grid_.centre(cell.column, cell.row);
      if (lies_in(request_.area, centre)) box.extend(centre);
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
                                         const CellBlock& cells, const SurfaceFits& fits) {
  std::vector<IndexSegment> segments;
  IndexPlan(store, request, grid, fits).divide(cells, segments);
  return segments;
}

}  // namespace itin::viewshed
