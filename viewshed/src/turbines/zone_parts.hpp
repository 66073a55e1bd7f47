// A zone of visibility cut into parts that are surveyed one after another, so that the surface under each fits into the
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

struct ZonePart {
  Window window;                   ///< holds every sight line of its tiles
  std::vector<std::size_t> tiles;  ///< of grid_of_tiles(zone.grid)
};

/// Holds all lines to every turbine, and to the radar.
Window window_of(const ZoneRequest& request);

ZonePart whole_zone(const Zone& zone);

/// Of what is told of the cells, over the bare ground.
std::uint64_t bytes_of_results(const Zone& zone);

/// One part of all tiles where the zone's memory_bytes hold that, or are not given; else tiles in order of their
/// azimuth, as many together as they hold. Throws InputError where that is impossible, saying about how much is needed.
std::vector<ZonePart> zone_parts(const Store& store, const Zone& zone, bool screened);

}  // namespace itin::viewshed
