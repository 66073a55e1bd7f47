// Raster files as GDAL opens them.
#pragma once

#include <string>

#include <gdal_priv.h>

namespace itin {

/// Throws FileError, also where the file is missing, empty, a pipe or no raster. Within the life of a QuietGdal.
GDALDatasetUniquePtr open_raster_file(const std::string& path);

}  // namespace itin
