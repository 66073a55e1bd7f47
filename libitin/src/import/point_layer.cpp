#include "import/point_layer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <cpl_conv.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/error.hpp>

#include "import/crs.hpp"
#include "import/quiet_gdal.hpp"
#include "import/vector_layer.hpp"

namespace itin {

namespace {

constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

bool is_point_type(OGRwkbGeometryType type) {
  return wkbFlatten(type) == wkbPoint || wkbFlatten(type) == wkbMultiPoint;
}

class PointLayer final : public PointReader {
 public:
  PointLayer(const std::string& path, const ImportOptions& options);

  const std::string& path() const override { return path_; }
  std::string crs() const override;
  Point2 centre() const override { return centre_; }
  double size_hint() const override { return static_cast<double>(matching_); }
  std::uint64_t read(const Sink& sink) override;

 private:
  void check_geometry_type() const;
  Point2 find_centre();
  OGRFeatureUniquePtr next_feature();
  void add(const OGRFeature& feature, PointBatch& batch) const;
  void add(const OGRPoint& point, const OGRFeature& feature, PointBatch& batch) const;
  double attribute_height(const OGRFeature& feature) const;
  [[noreturn]] void refuse_geometry(const std::string& type) const;
  [[noreturn]] void refuse_heightless() const;
  std::string place(const OGRFeature& feature) const;

  std::string path_;
  GDALDatasetUniquePtr dataset_;
  OGRLayer* layer_ = nullptr;
  int height_field_ = -1;  ///< -1: Z of the geometry
  GIntBig matching_ = 0;
  std::uint64_t filtered_ = 0;
  Point2 centre_;
};

PointLayer::PointLayer(const std::string& path, const ImportOptions& options) : path_(path) {
  const QuietGdal quiet;
  dataset_.reset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  if (!dataset_) throw FileError(path, "cannot be read as a point layer: " + QuietGdal::message("unknown error"));
  layer_ = &choose_layer(*dataset_, path, options.layer);
  check_geometry_type();
  if (!options.z_field.empty()) height_field_ = field_of_layer(*layer_, path, options.z_field);
  const GIntBig all = layer_->GetFeatureCount();
  if (!options.where.empty()) select_features(*layer_, path, options.where);
  matching_ = layer_->GetFeatureCount();
  filtered_ = static_cast<std::uint64_t>(std::max<GIntBig>(0, all - matching_));
  centre_ = find_centre();
}

void PointLayer::check_geometry_type() const {
  const OGRwkbGeometryType type = layer_->GetGeomType();
  if (type == wkbNone)
    throw InputError(fmt::format("{}: layer '{}' has no geometry; give a layer of points", path_, layer_->GetName()));
  // Of an unknown type each feature is judged by itself.
  if (wkbFlatten(type) != wkbUnknown && !is_point_type(type)) refuse_geometry(OGRGeometryTypeToName(type));
}

void PointLayer::refuse_geometry(const std::string& type) const {
  throw InputError(fmt::format(
      "{}: layer '{}' holds {}, not points; import lines and polygons with --kind contours, breaklines, buildings, ...",
      path_, layer_->GetName(), type));
}

void PointLayer::refuse_heightless() const {
  throw InputError(
      height_field_ < 0
          ? fmt::format("{}: the points of layer '{}' have no Z; name the field of the height with --z-field", path_,
                        layer_->GetName())
          : fmt::format("{}: layer '{}' has a height in no feature; check --z-field", path_, layer_->GetName()));
}

std::string PointLayer::crs() const {
  const OGRSpatialReference* reference = layer_->GetSpatialRef();
  return reference ? wkt_of(*reference) : std::string();
}

/// The next feature; null at the end. GDAL tells an end from a failure only by its error state, which others may leave
/// set between two calls.
OGRFeatureUniquePtr PointLayer::next_feature() {
  const QuietGdal quiet;
  OGRFeatureUniquePtr feature(layer_->GetNextFeature());
  if (!feature && QuietGdal::failed()) throw FileError(path_, QuietGdal::message("unknown error"));
  return feature;
}

Point2 PointLayer::find_centre() {
  layer_->ResetReading();
  PointBatch batch;
  while (const auto feature = next_feature()) {
    add(*feature, batch);
    if (batch.size() == 0 || std::isnan(batch.x.front())) {
      batch.clear();
      continue;
    }
    // Layers declared flat sometimes hold points with Z all the same, so the first feature has its say.
    if (height_field_ < 0 && !wkbHasZ(layer_->GetGeomType()) && std::isnan(batch.z.front())) refuse_heightless();
    return {batch.x.front(), batch.y.front()};
  }
  throw FileError(path_, fmt::format("layer '{}' holds no points{}", layer_->GetName(),
                                     filtered_ > 0 ? " that match --where" : ""));
}

std::uint64_t PointLayer::read(const Sink& sink) {
  PointBatch batch;
  GIntBig done = 0;
  bool any_height = false;
  const auto hand_on = [&] {
    any_height = any_height || !std::all_of(batch.z.begin(), batch.z.end(), [](double z) { return std::isnan(z); });
    sink(batch, std::min(1.0, static_cast<double>(done) / static_cast<double>(std::max<GIntBig>(1, matching_))));
    batch.clear();
  };
  layer_->ResetReading();
  while (const auto feature = next_feature()) {
    add(*feature, batch);
    ++done;
    if (batch.size() >= kPointBatchSize) hand_on();
  }
  if (batch.size() > 0) hand_on();
  if (!any_height) refuse_heightless();
  return filtered_;
}

void PointLayer::add(const OGRFeature& feature, PointBatch& batch) const {
  const OGRGeometry* geometry = feature.GetGeometryRef();
  if (!geometry || geometry->IsEmpty()) return batch.add(kVoid, kVoid, kVoid);
  const OGRwkbGeometryType type = geometry->getGeometryType();
  if (wkbFlatten(type) == wkbPoint) return add(*geometry->toPoint(), feature, batch);
  if (wkbFlatten(type) != wkbMultiPoint) refuse_geometry(OGRGeometryTypeToName(type));
  for (const OGRPoint* point : *geometry->toMultiPoint())
    if (!point->IsEmpty()) add(*point, feature, batch);
}

void PointLayer::add(const OGRPoint& point, const OGRFeature& feature, PointBatch& batch) const {
  if (!std::isfinite(point.getX()) || !std::isfinite(point.getY()))
    throw InputError(fmt::format("{}: a coordinate is not a finite number", place(feature)));
  if (height_field_ >= 0) return batch.add(point.getX(), point.getY(), attribute_height(feature));
  if (!point.Is3D()) return batch.add(point.getX(), point.getY(), kVoid);
  if (!std::isfinite(point.getZ())) throw InputError(fmt::format("{}: Z is not a finite number", place(feature)));
  batch.add(point.getX(), point.getY(), point.getZ());
}

/// NaN for null.
double PointLayer::attribute_height(const OGRFeature& feature) const {
  if (!feature.IsFieldSetAndNotNull(height_field_)) return kVoid;
  const OGRFieldDefn& field = *feature.GetFieldDefnRef(height_field_);
  const double height = feature.GetFieldAsDouble(height_field_);
  const bool numeric =
      field.GetType() != OFTString || CPLGetValueType(feature.GetFieldAsString(height_field_)) != CPL_VALUE_STRING;
  if (!numeric || !std::isfinite(height))
    throw InputError(fmt::format("{}: {} '{}' is not a finite number", place(feature), field.GetNameRef(),
                                 feature.GetFieldAsString(height_field_)));
  return height;
}

std::string PointLayer::place(const OGRFeature& feature) const {
  return fmt::format("{}: layer '{}': feature {}", path_, layer_->GetName(), feature.GetFID());
}

}  // namespace

std::unique_ptr<PointReader> open_point_layer(const std::string& path, const ImportOptions& options) {
  return std::make_unique<PointLayer>(path, options);
}

}  // namespace itin
