// Where the axes of a projected CRS's grid run.
//
//   runs_east_north("EPSG:2048")    // false: South Africa's grid counts to the west and to the south
#pragma once

#include <string>

namespace itin {

/// Tells whether coordinates count to the east and to the north, or along meridians at a pole. A store's do, unless it
/// was made before imports minded that; azimuths, wedges, drawings and north arrows count on it. Throws InputError.
bool runs_east_north(const std::string& crs);

}  // namespace itin
