// A layer of features in any vector format GDAL reads, opened and filtered, whatever its geometry.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/import.hpp>

#include "import/source/feature_fields.hpp"

namespace itin {

/// With these open options, which may be null. `what` says in messages what it should hold: "a layer of points". Throws
/// FileError, also where the file is missing, empty, a pipe or a raster. Within the life of a QuietGdal.
GDALDatasetUniquePtr open_vector_file(const std::string& path, const char* const* options,
                                      const std::string& what = "a vector file");

/// Whether it is the table in which a GeoPackage keeps how QGIS draws its layers.
bool holds_styles(OGRLayer& layer);

/// The layer of that name; for an empty name the only one. Throws FileError.
OGRLayer& choose_layer(GDALDataset& dataset, const std::string& path, const std::string& name);

/// Throws FileError where the layer has no such field.
int field_of_layer(OGRLayer& layer, const std::string& path, const std::string& name);

std::vector<std::string> field_names(OGRLayer& layer);

/// Restricts what is read to `where`, in OGR's SQL or the database's own; all, where that is empty. How many features
/// it leaves out. Throws FileError for a field that the layer has not, InputError for a clause that makes no sense or
/// leaves no feature of some. Within the life of a QuietGdal.
std::uint64_t select_features(OGRLayer& layer, const std::string& path, const std::string& where);

/// The next feature; null at the end. Throws FileError where reading fails.
OGRFeatureUniquePtr next_feature(OGRLayer& layer, const std::string& path);

/// Whether there is anything on the map: databases may have features with a null geometry, or an empty one.
bool has_geometry(const OGRFeature& feature);

class SourceLayer {
 public:
  /// Opens the layer that options.layer names, otherwise the file's only one. `what` as in
  /// open_vector_file(). Throws FileError.
  SourceLayer(std::string path, const ImportOptions& options, const std::string& what);

  /// Takes options.z_field as the field of heights and options.where as the filter. Throws FileError (no such field),
  /// InputError
  /// (a where clause that is not understood, or leaves nothing).
  void select(const ImportOptions& options);

  const std::string& path() const { return path_; }
  std::string name() const { return layer_->GetName(); }
  /// The CRS by the layer itself, as WKT; empty if it says nothing.
  std::string crs() const;
  OGRwkbGeometryType geometry_type() const { return layer_->GetGeomType(); }
  bool has_height_field() const { return height_field_ >= 0; }
  /// What is kept of the features. Throws FileError, InputError.
  FeatureFields feature_fields(const ImportOptions& options) const;
  /// Features that the filter lets pass, and those it does not.
  std::uint64_t matching() const { return matching_; }
  std::uint64_t filtered() const { return filtered_; }

  void rewind() { layer_->ResetReading(); }
  OGRFeatureUniquePtr next() { return next_feature(*layer_, path_); }
  /// The value of the height field; NaN for null. Throws InputError.
  double height(const OGRFeature& feature) const;
  /// For messages: file, layer and feature.
  std::string place(const OGRFeature& feature) const;

 private:
  std::string path_;
  GDALDatasetUniquePtr dataset_;
  OGRLayer* layer_ = nullptr;
  int height_field_ = -1;
  std::uint64_t matching_ = 0, filtered_ = 0;
};

}  // namespace itin
