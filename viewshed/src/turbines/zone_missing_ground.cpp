#include <algorithm>

#include <viewshed/missing_ground.hpp>

#include "request/cells_in_view.hpp"
#include "turbines/zone_request.hpp"

namespace itin::viewshed {

namespace {

/// Calls found(place) on any thread for each cell within the radii that has no ground. Returns the number of these
/// cells.
template <class Found>
std::uint64_t for_each_without_ground(const Zone& zone, const Found& found) {
  return for_each_cell_in_view(
      view_of(zone.request), zone.grid,
      [&](RasterGrid::Cell place) { return zone.bare.tip_count[zone.grid.index(place)] == kCountOutside; }, found);
}

}  // namespace

std::vector<std::uint8_t> cells_without_ground(const Zone& zone) {
  std::vector<std::uint8_t> cells(zone.grid.cell_count());
  for_each_without_ground(zone, [&](RasterGrid::Cell place) { cells[zone.grid.index(place)] = 1; });
  return cells;
}

PlacesWithoutGround places_without_ground(const Zone& zone) {
  CellsBeyond beyond = cells_beyond(view_of(zone.request), zone.grid);
  return PlacesWithoutGround({{zone.grid, cells_without_ground(zone)}, {beyond.grid, std::move(beyond.cells)}});
}

MissingGround missing_ground(const Zone& zone) {
  const std::vector<std::uint16_t>& counts = zone.bare.tip_count;
  MissingGround missing;
  missing.cell_area = zone.grid.cell_area();
  missing.without_ground = for_each_without_ground(zone, [](RasterGrid::Cell) {});
  missing.with_ground =
      counts.size() - static_cast<std::uint64_t>(std::count(counts.begin(), counts.end(), kCountOutside));
  missing.beyond = static_cast<std::uint64_t>(cells_beyond(view_of(zone.request), zone.grid).count());
  return missing;
}

}  // namespace itin::viewshed
