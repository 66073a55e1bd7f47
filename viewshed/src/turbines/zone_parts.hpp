// A zone of visibility cut into parts that are computed one after another, so that the surface under each fits into the
// memory.
//
//   for (const ZonePart& part : zone_parts(store, zone, screened)) ...
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <itin/store.hpp>
#include <itin/window.hpp>
#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// The part of a zone that is decided by reading the ground once, or the ground and what stands on it.
struct ZonePart {
  Window window;                            ///< holds every sight line of the members below
  std::vector<std::size_t> tiles;           ///< places in grid_of_tiles(zone.grid) from which turbines are looked for
  std::vector<std::size_t> radar_tiles;     ///< tiles over whose cells the radar's least visible heights are found
  std::vector<std::size_t> radar_turbines;  ///< indices in zone.request.turbines of those that the radar looks for
  std::uint64_t points = 0;                 ///< about as many as the ground within the window has
};

/// Returns a window that holds all lines to every turbine, and from the radar to the turbines and to every cell.
Window window_of(const ZoneRequest& request);

ZonePart whole_zone(const Zone& zone);

/// Returns one part with everything where the zone's memory_bytes hold that, or are not given. Otherwise the tiles are
/// sorted by azimuth about the turbines, and each part takes as many as fit into the memory; parts for the radar, over
/// the bare ground alone, follow in the same way. Throws InputError where the ground of a single tile does not fit,
/// saying about how much is needed.
std::vector<ZonePart> zone_parts(const Store& store, const Zone& zone, bool screened);

}  // namespace itin::viewshed
