#include "plan/point_counts.hpp"

#include <algorithm>

#include "line/cell_tiles.hpp"
#include "line/hulls.hpp"

namespace itin::viewshed {

namespace {

constexpr double kCellsPerSide = 48;

bool may_meet(const Window& window, const Box& box) {
  std::vector<Point2> corners;
  add_corners(box, corners);
  return window.is_all() || std::any_of(window.parts().begin(), window.parts().end(), [&](const Window::Polygon& part) {
           return !beyond_a_side(part.outer, corners);
         });
}

}  // namespace

PointCounts::PointCounts(const Store& store, int level, const Box& box)
    : cells_(RasterGrid::aligned(box, std::max(box.width(), box.height()) / kCellsPerSide)) {
  for (std::size_t i = 0; i < cells_.cell_count(); ++i)
    counts_.push_back(store.points_about(level, box_of_cell(cells_, place_of(cells_, i))));
}

std::uint64_t PointCounts::within(const Window& window) const {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i)
    if (counts_[i] > 0 && may_meet(window, box_of_cell(cells_, place_of(cells_, i)))) count += counts_[i];
  return count;
}

}  // namespace itin::viewshed
