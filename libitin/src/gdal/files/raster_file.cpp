#include "gdal/files/raster_file.hpp"

#include <itin/error.hpp>
#include <itin/raster_values.hpp>

#include "gdal/files/ascii_grid.hpp"
#include "gdal/files/drivers.hpp"
#include "gdal/files/quiet_gdal.hpp"
#include "gdal/files/source_path.hpp"

namespace itin {

namespace {

bool is_text_of_points(GDALDriver& driver) {
  return EQUAL(driver.GetDescription(), "XYZ");
}

}  // namespace

GDALDatasetUniquePtr open_raster_file(const std::string& path) {
  require_plain_file(path);
  const QuietGdal quiet;
  GDALDatasetUniquePtr dataset = open_dataset(path, GDAL_OF_RASTER);
  if (!dataset) throw FileError(path, why_not_read(path, "a raster"));
  require_whole_ascii_grid(*dataset, path);
  return dataset;
}

bool is_raster(const std::string& path) {
  const QuietGdal quiet;
  GDALDriver* const driver = driver_of(path, GDAL_OF_RASTER);
  if (!driver || is_text_of_points(*driver)) return false;
  if (!driver->GetMetadataItem(GDAL_DCAP_VECTOR)) return true;
  // A GeoPackage, for example, may hold rasters or vectors; only opening it tells.
  return open_dataset(path, GDAL_OF_RASTER) != nullptr;
}

}  // namespace itin
