#include "import/vectors/place_file.hpp"

#include <cmath>

#include <cpl_conv.h>
#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/position_columns.hpp>

#include "gdal/crs.hpp"
#include "import/source/source_layer.hpp"

namespace itin {

namespace {

bool is_csv(GDALDataset& file) {
  return file.GetDriver() != nullptr && EQUAL(file.GetDriver()->GetDescription(), "CSV");
}

std::optional<PositionColumns> columns_of(OGRLayer& layer) {
  return position_columns(field_names(layer));
}

/// GDAL makes points of one pair of columns only, which it must be told on opening.
std::vector<std::string> open_options(const std::string& path, ColumnTypes types) {
  const GDALDatasetUniquePtr file = open_vector_file(path, nullptr);
  if (!is_csv(*file) || file->GetLayerCount() != 1) return {};
  std::vector<std::string> options;
  if (types == ColumnTypes::kDeclared) options.emplace_back("AUTODETECT_TYPE=YES");
  OGRLayer& layer = *file->GetLayer(0);
  const auto columns = columns_of(layer);
  if (!columns) return options;
  const std::vector<std::string> names = field_names(layer);
  options.push_back("X_POSSIBLE_NAMES=" + names[columns->x]);
  options.push_back("Y_POSSIBLE_NAMES=" + names[columns->y]);
  return options;
}

}  // namespace

GDALDatasetUniquePtr open_place_file(const std::string& path, ColumnTypes types) {
  const std::vector<std::string> options = open_options(path, types);
  std::vector<const char*> list;
  for (const std::string& option : options) list.push_back(option.c_str());
  list.push_back(nullptr);
  return open_vector_file(path, list.data());
}

Places::Places(GDALDataset& file, OGRLayer& layer, const SiteQuery& query, const std::string& to_crs)
    : csv_(is_csv(file)) {
  const auto columns = csv_ ? columns_of(layer) : std::nullopt;
  if (columns) columns_ = {static_cast<int>(columns->x), static_cast<int>(columns->y)};
  const OGRSpatialReference* own = layer.GetSpatialRef();
  std::string from_crs = own != nullptr ? wkt_of(*own) : query.crs;
  if (from_crs.empty() && columns && columns->geographic) from_crs = kGeographicColumnsCrs;
  if (!from_crs.empty() && !to_crs.empty()) transform_.emplace(from_crs, to_crs);
}

/// GDAL reads a coordinate that is no number as 0, or leaves the point out.
std::string Places::wrong_coordinate(const OGRFeature& feature) const {
  for (const int field : columns_) {
    const char* name = feature.GetFieldDefnRef(field)->GetNameRef();
    const std::string text = feature.IsFieldSetAndNotNull(field) ? feature.GetFieldAsString(field) : "";
    char* end = nullptr;
    const double value = CPLStrtod(text.c_str(), &end);
    if (text.empty()) return fmt::format("its {} is empty or not a number", name);
    if (*end != '\0' || !std::isfinite(value)) return fmt::format("its {} '{}' is not a number", name, text);
  }
  return {};
}

std::string Places::find(const OGRFeature& feature, Point2& place) const {
  if (std::string wrong = wrong_coordinate(feature); !wrong.empty()) return wrong;
  const OGRGeometry* geometry = feature.GetGeometryRef();
  if (geometry == nullptr || geometry->IsEmpty())
    return csv_ && columns_.empty()
               ? fmt::format("it has no point; the header of a CSV file must name {}", kPositionColumnsAdvice)
               : "it has no point";
  const OGRPoint* point = nullptr;
  if (wkbFlatten(geometry->getGeometryType()) == wkbPoint) point = geometry->toPoint();
  if (wkbFlatten(geometry->getGeometryType()) == wkbMultiPoint && geometry->toMultiPoint()->getNumGeometries() == 1)
    point = geometry->toMultiPoint()->getGeometryRef(0);
  if (point == nullptr) return fmt::format("it is a {}, not a point", geometry->getGeometryName());
  place = {point->getX(), point->getY()};
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) return "its position is not finite";
  try {
    if (transform_) place = (*transform_)(place);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace itin
