// GDAL's formats, registered when the first call needs them. All 210 take 9 MB and 2 ms. The formats that itin writes
// take 2 MB. They come first; all others are registered when a file is opened that is none of these.
#pragma once

#include <string>

#include <gdal_priv.h>

namespace itin {

/// Opens a file in any format for reading. `kinds` are GDAL_OF_RASTER, GDAL_OF_VECTOR or both. Null where GDAL cannot
/// open it. Throws FileError where it would send a request that is not allowed (network.hpp).
GDALDatasetUniquePtr open_dataset(const std::string& path, unsigned kinds, const char* const* options = nullptr);

/// Returns the driver that would open the file; null where there is none. Throws FileError as open_dataset() does.
GDALDriver* driver_of(const std::string& path, unsigned kinds);

/// Returns a format that itin writes: COG or GPKG, in memory MEM (rasters) or Memory (vectors). Null where this GDAL
/// lacks it.
GDALDriver* written_driver(const char* name);

}  // namespace itin
