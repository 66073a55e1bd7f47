#include "request/cells_in_view.hpp"

#include <algorithm>
#include <cmath>

#include "request/request.hpp"

namespace itin::viewshed {

namespace {

/// The box about all observers' radii; empty where an observer has no radius.
Box box_of_radii(const Request& request) {
  Box box;
  for (const Observer& observer : request.observers) {
    const std::optional<double> radius = radius_of(request, observer);
    if (!radius) return {};
    box.extend(square_about(observer.position, *radius));
  }
  return box;
}

}  // namespace

std::vector<MapView> views_of(const Request& request) {
  std::vector<MapView> views;
  for (const Observer& observer : request.observers) views.push_back({observer.position, {request, observer}});
  return views;
}

TileInView::TileInView(const std::vector<MapView>& views, const Box& centres) {
  for (const MapView& view : views) {
    all_ = all_ || view.holds(centres);
    if (view.reaches(centres)) near_.push_back(&view);
  }
}

bool TileInView::holds(Point2 centre) const {
  return all_ || std::any_of(near_.begin(), near_.end(), [&](const MapView* view) { return view->holds(centre); });
}

double CellsBeyond::count() const {
  return each * static_cast<double>(std::count(cells.begin(), cells.end(), 1));
}

CellsBeyond cells_beyond(const Request& request, const RasterGrid& grid) {
  constexpr double kMostCells = 4e6;
  if (request.grid) return {};
  const Box box = box_of_radii(request);
  if (box.empty()) return {};
  const double cells = box.width() / grid.cell_width() * (box.height() / grid.cell_height());
  const double larger = std::max(1.0, std::ceil(std::sqrt(cells / kMostCells)));
  const RasterGrid wide = RasterGrid::aligned(box, grid.cell_width() * larger);
  CellsBeyond beyond{wide, std::vector<std::uint8_t>(wide.cell_count()), larger * larger};
  const Box within = grid.bounds();
  const auto lies_beyond = [&](RasterGrid::Cell place) {
    const Point2 p = wide.centre(place.column, place.row);
    const bool inside = p.x > within.xmin && p.x < within.xmax && p.y > within.ymin && p.y < within.ymax;
    return !inside && !grid.cell_at(p);
  };
  for_each_cell_in_view(request, wide, lies_beyond,
                        [&](RasterGrid::Cell place) { beyond.cells[wide.index(place)] = 1; });
  return beyond;
}

}  // namespace itin::viewshed
