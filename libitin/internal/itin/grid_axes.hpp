// Where the axes of a projected CRS's grid run.
//
//   runs_east_north(store.metadata().crs_wkt)    // false for EPSG:2048, which counts to the west and to the south
#pragma once

#include <string>

namespace itin {

/// Tells whether coordinates in a projected CRS, given as WKT 2, count to the east and to the north, or along meridians
/// at a pole; their order does not matter. A store's do, unless it was made before imports minded that: azimuths,
/// wedges, drawings and north arrows count on it.
bool runs_east_north(const std::string& wkt);

}  // namespace itin
