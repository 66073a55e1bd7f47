#include "request/cells_in_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <itin/parallel.hpp>

#include "line/cell_tiles.hpp"
#include "request/field_of_view.hpp"
#include "request/request.hpp"

namespace itin::viewshed {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// An observer's field of view on the map.
struct MapView {
  Point2 position;
  FieldOfView view;

  bool reaches(const Box& box) const { return view.reaches(squared_distance(position, box)); }
  bool holds(Point2 p) const {
    return view.contains(p.x - position.x, p.y - position.y, -kInfinity, kInfinity).value_or(true);
  }
};

std::vector<MapView> views_of(const Request& request) {
  std::vector<MapView> views;
  for (const Observer& observer : request.observers) views.push_back({observer.position, {request, observer}});
  return views;
}

/// Nothing where an observer has no radius.
Box box_of_radii(const Request& request) {
  Box box;
  for (const Observer& observer : request.observers) {
    const std::optional<double> radius = radius_of(request, observer);
    if (!radius) return {};
    box.extend(disc_box(observer.position, *radius));
  }
  return box;
}

}  // namespace

std::vector<std::uint8_t> cells_in_view(const Request& request, const RasterGrid& grid,
                                        const std::function<bool(RasterGrid::Cell)>& asked) {
  const std::vector<MapView> all = views_of(request);
  std::vector<std::uint8_t> cells(grid.cell_count());
  const RasterGrid tiles = grid_of_tiles(grid);
  parallel_for(tiles.cell_count(), [&](std::size_t i) {
    const Tile tile = tile_at(grid, tiles, i);
    const Box box = box_of_centres(grid, tile);
    std::vector<const MapView*> near;
    for (const MapView& view : all)
      if (view.reaches(box)) near.push_back(&view);
    if (near.empty()) return;
    for_each_cell(tile, [&](std::size_t, RasterGrid::Cell place) {
      if (!asked(place)) return;
      const Point2 centre = grid.centre(place.column, place.row);
      cells[grid.index(place)] =
          std::any_of(near.begin(), near.end(), [&](const MapView* view) { return view->holds(centre); }) ? 1 : 0;
    });
  });
  return cells;
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
  const auto beyond = [&](RasterGrid::Cell c) { return !grid.cell_at(wide.centre(c.column, c.row)); };
  return {wide, cells_in_view(request, wide, beyond), larger * larger};
}

}  // namespace itin::viewshed
