#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/paths.hpp>
#include <itin/plain_text.hpp>

#include "gdal/files/quiet_gdal.hpp"
#include "import/source/layers/source_layer.hpp"
#include "import/vectors/layer_crs.hpp"

namespace itin {

namespace {

/// The first of two fields that has a value, else the text.
std::string first_of(const OGRFeature& feature, const char* first, const char* second, const std::string& otherwise,
                     PlainTexts& texts) {
  for (const char* field : {first, second}) {
    const int index = feature.GetFieldIndex(field);
    if (index >= 0 && feature.IsFieldSetAndNotNull(index))
      return texts.plain(feature.GetFieldAsString(index), fmt::format("feature {}", feature.GetFID()));
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

std::string id_of(const OGRFeature& feature, PlainTexts& texts) {
  return first_of(feature, "id", "name", std::to_string(feature.GetFID()), texts);
}

/// Reads a path. Throws InputError where the feature is no line.
Path path_of(const OGRFeature& feature, const CoordinateTransform* transform, PlainTexts& texts) {
  const OGRLineString* line = line_of(feature);
  if (line == nullptr || line->getNumPoints() < 2) throw InputError("is not one line of two or more points");
  Path path{feature.GetFID(), id_of(feature, texts), first_of(feature, "name", "id", "", texts), {}};
  for (int i = 0; i < line->getNumPoints(); ++i) {
    const Point2 p{line->getX(i), line->getY(i)};
    path.corners.push_back(transform != nullptr ? (*transform)(p) : p);
    path.has_z = path.has_z || line->getZ(i) != 0;
  }
  path.corners = without_repeats(std::move(path.corners));
  return path;
}

std::vector<OGRLayer*> chosen_layers(GDALDataset& dataset, const std::string& path, const PathChoice& choice) {
  if (!choice.layer.empty() || !choice.where.empty()) return {&choose_layer(dataset, path, choice.layer)};
  std::vector<OGRLayer*> layers;
  for (OGRLayer* layer : dataset.GetLayers())
    if (!holds_styles(*layer)) layers.push_back(layer);
  return layers;
}

void add_lines_of(OGRLayer& layer, const std::string& path, const std::string& crs, const std::string& to_crs,
                  PlainTexts& texts, PathFile& file) {
  std::optional<CoordinateTransform> transform;
  const LayerCrs own = crs_of_layer(layer, path, crs);
  if (!own.wkt.empty()) transform.emplace(own.wkt, to_crs);
  if (!own.warning.empty()) file.warnings.push_back(own.warning);
  while (const OGRFeatureUniquePtr feature = next_feature(layer, path)) {
    try {
      file.paths.push_back(path_of(*feature, transform ? &*transform : nullptr, texts));
    } catch (const InputError& error) {
      const std::size_t row = file.paths.size() + file.bad.size() + 1;
      file.bad.push_back({row, feature->GetFID(), id_of(*feature, texts), error.what()});
    }
  }
}

}  // namespace

PathFile read_path_file(const std::string& path, const std::string& to_crs, const PathChoice& choice) {
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = open_vector_file(path, nullptr);
  PathFile file;
  PlainTexts texts(path);
  for (OGRLayer* layer : chosen_layers(*dataset, path, choice)) {
    select_features(*layer, path, choice.where);
    add_lines_of(*layer, path, choice.crs, to_crs, texts, file);
  }
  for (std::string& line : texts.warnings()) file.warnings.push_back(std::move(line));
  return file;
}

std::vector<Path> read_paths(const std::string& path, const std::string& to_crs, std::vector<std::string>& warnings) {
  PathFile file = read_path_file(path, to_crs);
  warnings.insert(warnings.end(), file.warnings.begin(), file.warnings.end());
  if (!file.bad.empty())
    throw FileError(fmt::format("{}: feature {}", path, file.bad.front().feature), file.bad.front().message);
  return std::move(file.paths);
}

std::vector<Point2> without_repeats(std::vector<Point2> corners) {
  const Point2 last = corners.back();
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  if (corners.size() == 1) corners.push_back(last);
  return corners;
}

std::vector<double> distances_along(const std::vector<Point2>& corners) {
  std::vector<double> distances{0};
  for (std::size_t i = 1; i < corners.size(); ++i)
    distances.push_back(distances.back() +
                        std::hypot(corners[i].x - corners[i - 1].x, corners[i].y - corners[i - 1].y));
  return distances;
}

}  // namespace itin
