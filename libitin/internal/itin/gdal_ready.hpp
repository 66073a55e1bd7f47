// GDAL made ready before it is needed.
#pragma once

namespace itin {

/// Loads GDAL, where that is not done yet, and registers its drivers, which takes some 40 ms: what a call that will
/// write a raster does beside() its other work.
void make_gdal_ready();

}  // namespace itin
