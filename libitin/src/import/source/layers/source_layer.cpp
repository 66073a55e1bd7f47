#include "import/source/layers/source_layer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <cpl_conv.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/error.hpp>
#include <itin/lower_case.hpp>

#include "gdal/crs.hpp"
#include "gdal/files/archive.hpp"
#include "gdal/files/drivers.hpp"
#include "gdal/files/quiet_gdal.hpp"
#include "gdal/files/source_path.hpp"

namespace itin {

namespace {

/// Whether fields of such heights are often called so.
bool is_called_height(const std::string& field, HeightOf what) {
  const std::string name = in_lower_case(field);
  const auto is = [&](const char* other) { return name == other; };
  const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
  if (is("h") || has("height") || has("hoehe") || has("hoogte")) return true;
  return what == HeightOf::kTerrain && (is("z") || is("alt") || has("elev") || has("altitude") || has("contour"));
}

}  // namespace

std::optional<std::string> field_called_height(OGRLayer& layer, HeightOf what) {
  const OGRFeatureDefn& definition = *layer.GetLayerDefn();
  for (int i = 0; i < definition.GetFieldCount(); ++i) {
    const OGRFieldDefn& field = *definition.GetFieldDefn(i);
    const OGRFieldType type = field.GetType();
    const bool number = type == OFTReal || type == OFTInteger || type == OFTInteger64;
    const bool text = type == OFTString && what == HeightOf::kFeatures;  // "12 m"
    if ((number || text) && is_called_height(field.GetNameRef(), what)) return field.GetNameRef();
  }
  return std::nullopt;
}

GDALDatasetUniquePtr open_vector_file(const std::string& path, const char* const* options, const std::string& what) {
  require_plain_file(path);
  const QuietGdal quiet;
  GDALDatasetUniquePtr file = open_dataset(within_archive(path), GDAL_OF_VECTOR, options);
  if (!file) throw FileError(path, why_not_read(path, what));
  return file;
}

std::vector<std::string> field_names(OGRLayer& layer) {
  const OGRFeatureDefn& definition = *layer.GetLayerDefn();
  std::vector<std::string> names;
  for (int i = 0; i < definition.GetFieldCount(); ++i) names.emplace_back(definition.GetFieldDefn(i)->GetNameRef());
  return names;
}

bool holds_styles(OGRLayer& layer) {
  return EQUAL(layer.GetName(), "layer_styles");
}

OGRLayer& choose_layer(GDALDataset& dataset, const std::string& path, const std::string& name) {
  std::vector<std::string> names;
  for (OGRLayer* layer : dataset.GetLayers())
    if (!holds_styles(*layer)) names.emplace_back(layer->GetName());
  if (names.empty()) throw FileError(path, "has no layers");
  if (name.empty()) {
    if (names.size() == 1) return *dataset.GetLayerByName(names.front().c_str());
    throw FileError(path, fmt::format("has several layers; choose one with `layer`: {}", names));
  }
  if (OGRLayer* layer = dataset.GetLayerByName(name.c_str())) return *layer;
  throw FileError(path, fmt::format("has no layer '{}'; it has {}", name, names));
}

int field_of_layer(OGRLayer& layer, const std::string& path, const std::string& name) {
  const int index = layer.GetLayerDefn()->GetFieldIndex(name.c_str());
  if (index >= 0) return index;
  throw FileError(path,
                  fmt::format("layer '{}' has no field '{}'; it has {}", layer.GetName(), name, field_names(layer)));
}

namespace {

[[noreturn]] void refuse_clause(OGRLayer& layer, const std::string& path, const std::string& where) {
  const std::string reason = QuietGdal::message("GDAL does not say why");
  // These are the messages of OGR's own SQL, then SQLite's. The contract tells an unknown field from a clause that
  // makes no sense.
  if (reason.find("not recognised as an available field") != std::string::npos ||
      reason.find("no such column") != std::string::npos)
    throw FileError(path, fmt::format("`where` {} names a field that layer '{}' does not have: {}", where,
                                      layer.GetName(), reason));
  throw InputError(fmt::format("{}: `where` {} is not understood: {}", path, where, reason), "where");
}

}  // namespace

std::uint64_t select_features(OGRLayer& layer, const std::string& path, const std::string& where) {
  if (where.empty()) return 0;
  const GIntBig all = layer.GetFeatureCount();
  const QuietGdal filtering;
  // Databases look at the clause only when they count or read.
  const bool understood = layer.SetAttributeFilter(where.c_str()) == OGRERR_NONE;
  const GIntBig left = layer.GetFeatureCount();
  if (!understood || left < 0 || QuietGdal::failed()) refuse_clause(layer, path, where);
  if (left == 0 && all > 0)
    throw InputError(fmt::format("{}: `where` {} leaves none of {} feature{} of layer '{}'", path, where, all,
                                 all == 1 ? "" : "s", layer.GetName()),
                     "where");
  return static_cast<std::uint64_t>(std::max<GIntBig>(0, all - left));
}

/// GDAL tells the end from a failure only by its error state, which other code may leave set between two calls.
OGRFeatureUniquePtr next_feature(OGRLayer& layer, const std::string& path) {
  const QuietGdal quiet;
  OGRFeatureUniquePtr feature(layer.GetNextFeature());
  // A feature with a damaged geometry comes as one without.
  if (QuietGdal::failed() && (!feature || feature->GetGeometryRef() == nullptr))
    throw FileError(path, "a feature cannot be read: " + QuietGdal::message("GDAL does not say why"));
  return feature;
}

bool has_geometry(const OGRFeature& feature) {
  const OGRGeometry* geometry = feature.GetGeometryRef();
  return geometry != nullptr && !geometry->IsEmpty();
}

SourceLayer::SourceLayer(std::string path, const ImportOptions& options, const std::string& what)
    : path_(std::move(path)) {
  const QuietGdal quiet;
  dataset_ = open_vector_file(path_, nullptr, what);
  layer_ = &choose_layer(*dataset_, path_, options.layer);
}

void SourceLayer::select(const ImportOptions& options) {
  const QuietGdal quiet;
  if (!options.z_field.empty()) height_field_ = field_of_layer(*layer_, path_, options.z_field);
  filtered_ = select_features(*layer_, path_, options.where);
  matching_ = static_cast<std::uint64_t>(std::max<GIntBig>(0, layer_->GetFeatureCount()));
}

std::string SourceLayer::crs() const {
  const OGRSpatialReference* reference = layer_->GetSpatialRef();
  return reference ? wkt_of(*reference) : std::string();
}

FeatureFields SourceLayer::feature_fields(const ImportOptions& options) const {
  const QuietGdal quiet;
  return {*layer_, path_, feature_query(options)};
}

double SourceLayer::height(const OGRFeature& feature) const {
  if (!feature.IsFieldSetAndNotNull(height_field_)) return std::numeric_limits<double>::quiet_NaN();
  const OGRFieldDefn& field = *feature.GetFieldDefnRef(height_field_);
  const double value = feature.GetFieldAsDouble(height_field_);
  const bool numeric =
      field.GetType() != OFTString || CPLGetValueType(feature.GetFieldAsString(height_field_)) != CPL_VALUE_STRING;
  if (!numeric || !std::isfinite(value))
    throw InputError(fmt::format("{}: {} '{}' is not a finite number", place(feature), field.GetNameRef(),
                                 feature.GetFieldAsString(height_field_)));
  return value;
}

std::string SourceLayer::zero_heights() const {
  const auto field = field_called_height(*layer_, HeightOf::kTerrain);
  return field ? fmt::format("{0}: Z is 0 throughout; if heights are in the field '{1}', give `z_field` {1}", path_,
                             *field)
               : std::string();
}

std::string SourceLayer::place(const OGRFeature& feature) const {
  return fmt::format("{}: layer '{}': feature {}", path_, layer_->GetName(), feature.GetFID());
}

}  // namespace itin
