#include <algorithm>

#include <viewshed/missing_ground.hpp>

#include "request/cells_in_view.hpp"
#include "turbines/zone_request.hpp"

namespace itin::viewshed {

MissingGround missing_ground(const Zone& zone) {
  const std::vector<std::uint16_t>& counts = zone.bare.tip_count;
  const Request request = view_of(zone.request);
  MissingGround missing;
  missing.cell_area = zone.grid.cell_area();
  missing.cells = cells_in_view(
      request, zone.grid, [&](RasterGrid::Cell place) { return counts[zone.grid.index(place)] == kCountOutside; });
  missing.without_ground = static_cast<std::uint64_t>(std::count(missing.cells.begin(), missing.cells.end(), 1));
  missing.with_ground =
      counts.size() - static_cast<std::uint64_t>(std::count(counts.begin(), counts.end(), kCountOutside));
  missing.beyond = static_cast<std::uint64_t>(cells_beyond(request, zone.grid).count());
  return missing;
}

}  // namespace itin::viewshed
