// A GeoPackage that takes its name only when it is complete.
//
//   GeoPackage package(output, crs_wkt);
//   OGRLayer& layer = package.add_layer("links", wkbLineString25D);
//   package.add_field(layer, "id", OFTInteger64);
//   package.add(layer, feature);
//   package.close();
//   output.commit();
//
// Every failure throws FileError with the reason, as write_failure() words it.
#pragma once

#include <string>

#include <cpl_conv.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "export/pending_file.hpp"
#include "gdal/files/quiet_gdal.hpp"

namespace itin {

class GeoPackage {
 public:
  /// Creates the GeoPackage; without a CRS where `crs_wkt` is empty.
  GeoPackage(const PendingFile& output, const std::string& crs_wkt);

  OGRLayer& add_layer(const std::string& name, OGRwkbGeometryType type, bool spatial_index = true);
  void add_field(OGRLayer& layer, const std::string& name, OGRFieldType type);
  void add(OGRLayer& layer, OGRFeature& feature);
  GDALDataset& dataset() { return *dataset_; }
  const std::string& path() const { return path_; }
  /// Writes everything that is left, such as spatial indices.
  void close();

  void require(bool done, const char* otherwise = "cannot be written") const;

 private:
  QuietGdal quiet_;
  // Equal calls give equal bytes only if the file does not say when it was written.
  CPLConfigOptionSetter fixed_{"OGR_CURRENT_DATE", "1970-01-01T00:00:00.000Z", false};
  // Nothing has to be kept until the file is complete.
  CPLConfigOptionSetter unsynced_{"OGR_SQLITE_SYNCHRONOUS", "OFF", false};
  CPLConfigOptionSetter in_memory_{"OGR_SQLITE_JOURNAL", "MEMORY", false};
  std::string path_;
  OGRSpatialReference crs_;
  GDALDatasetUniquePtr dataset_;
};

}  // namespace itin
