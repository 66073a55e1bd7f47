#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gdal_priv.h>

#include <itin/error.hpp>
#include <itin/raster_values.hpp>

#include "import/quiet_gdal.hpp"

namespace itin {

RasterValues read_raster_values(const std::string& path, const std::string& crs_wkt) {
  RasterValues result{raster_grid_like(path, crs_wkt), {}};
  if (result.grid.cell_count() > (std::size_t{1} << 31))
    throw InputError(fmt::format("{}: has {} cells; resample it to fewer", path, result.grid.cell_count()));
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  if (!dataset || dataset->GetRasterCount() < 1) throw FileError(path, "no raster with a band that can be read");
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  result.values.resize(result.grid.cell_count());
  const int columns = static_cast<int>(result.grid.columns()), rows = static_cast<int>(result.grid.rows());
  if (band.RasterIO(GF_Read, 0, 0, columns, rows, result.values.data(), columns, rows, GDT_Float64, 0, 0, nullptr) !=
      CE_None)
    throw FileError(path, QuietGdal::message("could not be read"));
  int has_nodata = 0;
  const double nodata = band.GetNoDataValue(&has_nodata);
  for (double& value : result.values) {
    if (has_nodata != 0 && (value == nodata || (std::isnan(nodata) && std::isnan(value))))
      value = std::numeric_limits<double>::quiet_NaN();
  }
  return result;
}

}  // namespace itin
