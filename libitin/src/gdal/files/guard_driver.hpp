// A driver of GDAL that opens nothing. GDAL asks it before all others, about every name and file, those that a VRT
// names included; it refuses what would send requests, and descriptions with foreign_content().
#pragma once

namespace itin {

/// Puts the guard before the drivers that are registered, and takes out those that send requests, unless that is
/// allowed. To be called whenever drivers were registered, by one thread at a time.
void put_guard_first();

}  // namespace itin
