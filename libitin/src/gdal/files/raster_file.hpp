// Raster files as GDAL opens them.
#pragma once

#include <string>

#include <gdal_priv.h>

namespace itin {

/// Opens the file. Throws FileError, also where it is missing, empty, a pipe, no raster or an ASCII grid that is cut
/// short. Precondition: a QuietGdal lives.
GDALDatasetUniquePtr open_raster_file(const std::string& path);

}  // namespace itin
