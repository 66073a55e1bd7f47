#include <array>
#include <cmath>

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <itin/error.hpp>
#include <itin/raster.hpp>

#include "gdal/crs.hpp"
#include "gdal/files/quiet_gdal.hpp"
#include "gdal/files/raster_file.hpp"
#include "import/rasters/raster_source.hpp"

namespace itin {

RasterGrid raster_grid_like(const std::string& path, const std::string& crs_wkt) {
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = open_raster_file(path);
  std::array<double, 6> affine{};
  if (dataset->GetGeoTransform(affine.data()) != CE_None)
    throw InputError(path + ": has no georeference, so its grid is unknown");
  if (affine[2] != 0 || affine[4] != 0 || affine[1] <= 0 || affine[5] >= 0)
    throw InputError(path + ": its rows do not run from west to east and north to south; warp it north-up first");
  const std::string crs = crs_text(*dataset);
  if (!crs.empty() && !crs_wkt.empty() &&
      !same_crs(horizontal_crs(crs, path), horizontal_crs(crs_wkt, "the store's CRS")))
    throw InputError(path + ": its CRS is not the store's; warp it to the store's CRS first");
  return {{affine[0], affine[3]}, affine[1], -affine[5], dataset->GetRasterXSize(), dataset->GetRasterYSize()};
}

}  // namespace itin
