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

/// The part that one reading of the ground decides, or of the ground and of what stands on it.
struct ZonePart {
  Window window;                            ///< holds every sight line of what follows
  std::vector<std::size_t> tiles;           ///< places in grid_of_tiles(zone.grid): turbines are looked for from there
  std::vector<std::size_t> radar_tiles;     ///< over their cells the radar's heights are looked for
  std::vector<std::size_t> radar_turbines;  ///< indices in zone.request.turbines: those that the radar looks for
};

/// Holds all lines to every turbine, and from the radar to them and to every cell.
Window window_of(const ZoneRequest& request);

ZonePart whole_zone(const Zone& zone);

/// One part of everything where the zone's memory_bytes hold that, or are not given. Else tiles in the order of their
/// azimuth about the turbines, as many together as they hold, and then, over the bare ground alone, about the radar.
/// Throws InputError where that is impossible, saying about how much is needed.
std::vector<ZonePart> zone_parts(const Store& store, const Zone& zone, bool screened);

}  // namespace itin::viewshed
