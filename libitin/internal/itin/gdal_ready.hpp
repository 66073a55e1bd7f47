// Makes GDAL ready before it is needed.
#pragma once

namespace itin {

/// Loads GDAL, where that is not done yet, and registers the drivers of itin's output formats and of tables, which
/// takes some 30 ms. A call that will write a raster does this beside() its other work.
void make_gdal_ready();

}  // namespace itin
