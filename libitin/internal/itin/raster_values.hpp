// The values of a raster file, for weights and costs of places.
//
//   RasterValues population = read_raster_values("population.tif", store.metadata().crs_wkt);
//   population.values[population.grid.index({column, row})];
#pragma once

#include <string>
#include <vector>

#include <itin/raster.hpp>

namespace itin {

struct RasterValues {
  RasterGrid grid;
  std::vector<double> values;  ///< row by row from the north-west; NaN where the file has no data
};

/// Tells whether GDAL takes the file for a raster. Text of scattered points is no raster, even where GDAL would grid
/// it.
bool is_raster(const std::string& path);

/// Reads the only band besides masks (alpha), with scale and offset applied. Throws FileError if GDAL cannot read it,
/// InputError as raster_grid_like() does, for several bands, and for more than 2^31 cells.
RasterValues read_raster_values(const std::string& path, const std::string& crs_wkt);

}  // namespace itin
