#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/paths.hpp>

#include "gdal/crs.hpp"
#include "gdal/quiet_gdal.hpp"
#include "import/source/source_layer.hpp"

namespace itin {

namespace {

/// The first of two fields that has a value, else the text.
std::string first_of(const OGRFeature& feature, const char* first, const char* second, const std::string& otherwise) {
  for (const char* field : {first, second}) {
    const int index = feature.GetFieldIndex(field);
    if (index >= 0 && feature.IsFieldSetAndNotNull(index)) return feature.GetFieldAsString(index);
  }
  return otherwise;
}

const OGRLineString* line_of(const OGRFeature& feature) {
  const OGRGeometry* geometry = feature.GetGeometryRef();
  if (geometry == nullptr) return nullptr;
  const OGRwkbGeometryType type = wkbFlatten(geometry->getGeometryType());
  if (type == wkbLineString) return geometry->toLineString();
  if (type != wkbMultiLineString || geometry->toMultiLineString()->getNumGeometries() != 1) return nullptr;
  return geometry->toMultiLineString()->getGeometryRef(0);
}

Path path_of(const OGRFeature& feature, const std::string& place, const CoordinateTransform* transform) {
  const OGRLineString* line = line_of(feature);
  if (line == nullptr || line->getNumPoints() < 2) throw FileError(place, "is not one line of two or more points");
  Path path{feature.GetFID(),
            first_of(feature, "id", "name", std::to_string(feature.GetFID())),
            first_of(feature, "name", "id", ""),
            {}};
  for (int i = 0; i < line->getNumPoints(); ++i) {
    const Point2 p{line->getX(i), line->getY(i)};
    try {
      path.corners.push_back(transform != nullptr ? (*transform)(p) : p);
    } catch (const InputError& error) {
      throw FileError(place, error.what());
    }
  }
  return path;
}

}  // namespace

std::vector<Path> read_paths(const std::string& path, const std::string& to_crs) {
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = open_vector_file(path, nullptr);
  std::vector<Path> paths;
  for (OGRLayer* layer : dataset->GetLayers()) {
    if (holds_styles(*layer)) continue;
    std::optional<CoordinateTransform> transform;
    if (const OGRSpatialReference* own = layer->GetSpatialRef()) transform.emplace(wkt_of(*own), to_crs);
    while (const OGRFeatureUniquePtr feature = next_feature(*layer, path)) {
      const std::string place = fmt::format("{}: feature {}", path, feature->GetFID());
      paths.push_back(path_of(*feature, place, transform ? &*transform : nullptr));
    }
  }
  return paths;
}

std::vector<double> distances_along(const std::vector<Point2>& corners) {
  std::vector<double> distances{0};
  for (std::size_t i = 1; i < corners.size(); ++i)
    distances.push_back(distances.back() +
                        std::hypot(corners[i].x - corners[i - 1].x, corners[i].y - corners[i - 1].y));
  return distances;
}

}  // namespace itin
