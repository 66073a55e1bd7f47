// A layer of features in any vector format GDAL reads, opened and filtered, whatever its geometry.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/import.hpp>

#include "import/source/layers/feature_fields.hpp"

namespace itin {

/// Opens a file, or the one in a .zip, with these open options, which may be null. `what` says in messages what the
/// file should hold: "a layer of points". Throws FileError, also where the file is missing, empty, a pipe or a raster.
/// To be called within the life of a QuietGdal.
GDALDatasetUniquePtr open_vector_file(const std::string& path, const char* const* options,
                                      const std::string& what = "a vector file");

/// Whether a layer is the table in which a GeoPackage keeps how QGIS draws its layers.
bool holds_styles(OGRLayer& layer);

/// Returns the layer with that name; for an empty name the only layer. Throws FileError.
OGRLayer& choose_layer(GDALDataset& dataset, const std::string& path, const std::string& name);

/// Returns the index of a field. Throws FileError where the layer has no such field.
int field_of_layer(OGRLayer& layer, const std::string& path, const std::string& name);

std::vector<std::string> field_names(OGRLayer& layer);

/// Heights of the terrain's points and lines above a datum, or of features above the ground.
enum class HeightOf { kTerrain, kFeatures };
/// Returns the first field whose name is one that such heights often go by. Heights of features may be texts.
std::optional<std::string> field_called_height(OGRLayer& layer, HeightOf what);

/// Restricts what is read to `where`, in OGR's SQL or the database's own; if `where` is empty, all is read. Returns the
/// number of features left out. Throws FileError for a field that the layer does not have, InputError for a clause that
/// makes no sense or leaves none of the features. To be called within the life of a QuietGdal.
std::uint64_t select_features(OGRLayer& layer, const std::string& path, const std::string& where);

/// Reads the next feature; null at the end. Throws FileError where reading fails.
OGRFeatureUniquePtr next_feature(OGRLayer& layer, const std::string& path);

/// Whether a feature has something on the map: databases may have features with a null geometry, or an empty one.
bool has_geometry(const OGRFeature& feature);

class SourceLayer {
 public:
  /// Opens the layer that options.layer names, otherwise the file's only one. `what` is as in open_vector_file().
  /// Throws FileError.
  SourceLayer(std::string path, const ImportOptions& options, const std::string& what);

  /// Takes options.z_field as the field of heights and options.where as the filter. Throws FileError (no such field),
  /// InputError (a where clause that is not understood, or leaves nothing).
  void select(const ImportOptions& options);

  const std::string& path() const { return path_; }
  std::string name() const { return layer_->GetName(); }
  /// The CRS that the layer itself states, as WKT; empty if it says nothing.
  std::string crs() const;
  OGRwkbGeometryType geometry_type() const { return layer_->GetGeomType(); }
  bool has_height_field() const { return height_field_ >= 0; }
  /// Returns the fields that are kept of the features. Throws FileError, InputError.
  FeatureFields feature_fields(const ImportOptions& options) const;
  /// The numbers of features that the filter lets pass, and of those that it does not.
  std::uint64_t matching() const { return matching_; }
  std::uint64_t filtered() const { return filtered_; }

  void rewind() { layer_->ResetReading(); }
  OGRFeatureUniquePtr next() { return next_feature(*layer_, path_); }
  /// The value of the height field; NaN for null. Throws InputError.
  double height(const OGRFeature& feature) const;
  /// Returns a warning about Z that is 0 throughout where the layer has a field of heights; empty where it has none.
  std::string zero_heights() const;
  /// The place of a feature for messages: file, layer and feature.
  std::string place(const OGRFeature& feature) const;

 private:
  std::string path_;
  GDALDatasetUniquePtr dataset_;
  OGRLayer* layer_ = nullptr;
  int height_field_ = -1;
  std::uint64_t matching_ = 0, filtered_ = 0;
};

}  // namespace itin
