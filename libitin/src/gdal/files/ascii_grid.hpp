// The text of ESRI's ASCII grids, of which GDAL reads anything that is no number, and what is missing at the end, as 0.
#pragma once

#include <string>

#include <gdal_priv.h>

namespace itin {

/// Throws FileError, which names the row and column, unless all heights of the grid are there and are numbers. Does
/// nothing for rasters of other formats, and for files that GDAL finds within others, such as archives.
void require_whole_ascii_grid(GDALDataset& raster, const std::string& path);

}  // namespace itin
