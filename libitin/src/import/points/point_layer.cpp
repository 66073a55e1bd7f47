#include "import/points/point_layer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "import/source/layers/source_layer.hpp"
#include "import/source/middle_place.hpp"

namespace itin {

namespace {

constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

bool is_point_type(OGRwkbGeometryType type) {
  return wkbFlatten(type) == wkbPoint || wkbFlatten(type) == wkbMultiPoint;
}

class PointLayer final : public PointReader {
 public:
  PointLayer(const std::string& path, const ImportOptions& options);

  const std::string& path() const override { return layer_.path(); }
  std::string crs() const override { return layer_.crs(); }
  Point2 centre() const override { return centre_; }
  double size_hint() const override { return static_cast<double>(layer_.matching()); }
  std::uint64_t without_geometry() const override { return without_geometry_; }
  std::string warning() const override { return level_ ? layer_.zero_heights() : ""; }
  std::uint64_t read(const Sink& sink) override;

 private:
  void check_geometry_type() const;
  Point2 find_centre();
  void add(const OGRFeature& feature, PointBatch& batch) const;
  void add(const OGRPoint& point, const OGRFeature& feature, PointBatch& batch) const;
  [[noreturn]] void refuse_geometry(const std::string& type) const;
  [[noreturn]] void refuse_heightless() const;

  SourceLayer layer_;
  Point2 centre_;
  std::uint64_t without_geometry_ = 0;
  bool level_ = false;  ///< Z was 0 throughout
};

PointLayer::PointLayer(const std::string& path, const ImportOptions& options)
    : layer_(path, options, "a layer of points") {
  check_geometry_type();
  layer_.select(options);
  centre_ = find_centre();
}

void PointLayer::check_geometry_type() const {
  const OGRwkbGeometryType type = layer_.geometry_type();
  if (type == wkbNone)
    throw InputError(
        fmt::format("{}: layer '{}' has no geometry; give a layer of points", layer_.path(), layer_.name()));
  // In a layer of unknown type each feature is judged by itself.
  if (wkbFlatten(type) != wkbUnknown && !is_point_type(type)) refuse_geometry(OGRGeometryTypeToName(type));
}

void PointLayer::refuse_geometry(const std::string& type) const {
  throw InputError(fmt::format("{}: layer '{}' holds {}, not points; import lines and polygons with `kind` contours, "
                               "breaklines, buildings, ...",
                               layer_.path(), layer_.name(), type),
                   "kind");
}

void PointLayer::refuse_heightless() const {
  throw InputError(
      !layer_.has_height_field()
          ? fmt::format("{}: the points of layer '{}' have no Z; name the field of the height with `z_field`",
                        layer_.path(), layer_.name())
          : fmt::format("{}: layer '{}' has a height in no feature; check `z_field`", layer_.path(), layer_.name()),
      "z_field");
}

Point2 PointLayer::find_centre() {
  layer_.rewind();
  PointBatch batch;
  while (batch.size() < kFirstPlaces) {
    const auto feature = layer_.next();
    if (!feature) break;
    add(*feature, batch);
  }
  if (batch.size() > 0) {
    // Layers declared flat sometimes hold points with Z all the same, so the first feature decides.
    if (!layer_.has_height_field() && !wkbHasZ(layer_.geometry_type()) && std::isnan(batch.z.front()))
      refuse_heightless();
    std::vector<Point2> places;
    for (std::size_t i = 0; i < batch.size(); ++i) places.push_back({batch.x[i], batch.y[i]});
    return middle_place(std::move(places));
  }
  throw FileError(layer_.path(), fmt::format("layer '{}' holds no points{}", layer_.name(),
                                             layer_.filtered() > 0 ? " that match `where`" : ""));
}

std::uint64_t PointLayer::read(const Sink& sink) {
  PointBatch batch;
  std::uint64_t done = 0;
  bool any_height = false;
  const auto hand_on = [&] {
    level_ = level_ && std::all_of(batch.z.begin(), batch.z.end(), [](double z) { return z == 0; });
    any_height = any_height || !std::all_of(batch.z.begin(), batch.z.end(), [](double z) { return std::isnan(z); });
    sink(batch,
         std::min(1.0, static_cast<double>(done) / static_cast<double>(std::max<std::uint64_t>(1, layer_.matching()))));
    batch.clear();
  };
  layer_.rewind();
  without_geometry_ = 0;
  level_ = !layer_.has_height_field();
  while (const auto feature = layer_.next()) {
    if (!has_geometry(*feature)) ++without_geometry_;
    add(*feature, batch);
    ++done;
    if (batch.size() >= kPointBatchSize) hand_on();
  }
  if (batch.size() > 0) hand_on();
  if (!any_height) refuse_heightless();
  return layer_.filtered();
}

void PointLayer::add(const OGRFeature& feature, PointBatch& batch) const {
  if (!has_geometry(feature)) return;
  const OGRGeometry& geometry = *feature.GetGeometryRef();
  const OGRwkbGeometryType type = geometry.getGeometryType();
  if (wkbFlatten(type) == wkbPoint) return add(*geometry.toPoint(), feature, batch);
  if (wkbFlatten(type) != wkbMultiPoint) refuse_geometry(OGRGeometryTypeToName(type));
  for (const OGRPoint* point : *geometry.toMultiPoint())
    if (!point->IsEmpty()) add(*point, feature, batch);
}

void PointLayer::add(const OGRPoint& point, const OGRFeature& feature, PointBatch& batch) const {
  if (!std::isfinite(point.getX()) || !std::isfinite(point.getY()))
    throw InputError(fmt::format("{}: a coordinate is not a finite number", layer_.place(feature)));
  if (layer_.has_height_field()) return batch.add(point.getX(), point.getY(), layer_.height(feature));
  if (!point.Is3D()) return batch.add(point.getX(), point.getY(), kVoid);
  if (!std::isfinite(point.getZ()))
    throw InputError(fmt::format("{}: Z is not a finite number", layer_.place(feature)));
  batch.add(point.getX(), point.getY(), point.getZ());
}

}  // namespace

std::unique_ptr<PointReader> open_point_layer(const std::string& path, const ImportOptions& options) {
  return std::make_unique<PointLayer>(path, options);
}

}  // namespace itin
