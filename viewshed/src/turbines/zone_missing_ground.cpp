#include <algorithm>

#include <viewshed/missing_ground.hpp>

#include "request/cells_in_view.hpp"
#include "turbines/zone_request.hpp"

namespace itin::viewshed {

std::vector<std::uint8_t> cells_without_ground(const Zone& zone) {
  std::vector<std::uint8_t> cells(zone.grid.cell_count());
  for_each_cell_in_view(
      view_of(zone.request), zone.grid,
      [&](RasterGrid::Cell place) { return zone.bare.tip_count[zone.grid.index(place)] == kCountOutside; },
      [&](RasterGrid::Cell place) { cells[zone.grid.index(place)] = 1; });
  return cells;
}

MissingGround missing_ground(const Zone& zone) {
  const std::vector<std::uint16_t>& counts = zone.bare.tip_count;
  const std::vector<std::uint8_t> without = cells_without_ground(zone);
  MissingGround missing;
  missing.cell_area = zone.grid.cell_area();
  missing.without_ground = static_cast<std::uint64_t>(std::count(without.begin(), without.end(), 1));
  missing.with_ground =
      counts.size() - static_cast<std::uint64_t>(std::count(counts.begin(), counts.end(), kCountOutside));
  missing.beyond = static_cast<std::uint64_t>(cells_beyond(view_of(zone.request), zone.grid).count());
  return missing;
}

}  // namespace itin::viewshed
