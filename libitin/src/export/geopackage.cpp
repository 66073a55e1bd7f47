#include "export/geopackage.hpp"

#include <itin/error.hpp>

#include "gdal/files/drivers.hpp"
#include "gdal/files/write_failure.hpp"

namespace itin {

GeoPackage::GeoPackage(const PendingFile& output, const std::string& crs_wkt) : path_(output.path()) {
  require(crs_wkt.empty() || crs_.SetFromUserInput(crs_wkt.c_str()) == OGRERR_NONE,
          "the store's CRS is not understood");
  crs_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  GDALDriver* const driver = written_driver("GPKG");
  require(driver != nullptr, "this GDAL has no GeoPackage driver; choose another ending");
  dataset_.reset(driver->Create(output.temporary_path().c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  require(dataset_ != nullptr, "cannot be created");
}

OGRLayer& GeoPackage::add_layer(const std::string& name, OGRwkbGeometryType type, bool spatial_index) {
  CPLStringList options;
  options.SetNameValue("SPATIAL_INDEX", spatial_index ? "YES" : "NO");
  OGRLayer* const layer = dataset_->CreateLayer(name.c_str(), crs_.IsEmpty() ? nullptr : &crs_, type, options.List());
  require(layer != nullptr);
  return *layer;
}

void GeoPackage::add_field(OGRLayer& layer, const std::string& name, OGRFieldType type) {
  OGRFieldDefn field(name.c_str(), type);
  require(layer.CreateField(&field) == OGRERR_NONE);
}

void GeoPackage::add(OGRLayer& layer, OGRFeature& feature) {
  require(layer.CreateFeature(&feature) == OGRERR_NONE);
}

void GeoPackage::close() {
  const QuietGdal closing;
  dataset_.reset();
  require(!QuietGdal::failed());
}

void GeoPackage::require(bool done, const char* otherwise) const {
  if (!done) throw FileError(path_, write_failure(otherwise));
}

}  // namespace itin
