#include "import/place_file.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "import/crs.hpp"
#include "import/vector_layer.hpp"

namespace itin {

namespace {

/// GDAL reads a coordinate that is no number as 0, or leaves the point out.
std::string wrong_coordinate(const OGRFeature& feature) {
  constexpr std::array kNames{"x", "easting", "lon", "longitude", "y", "northing", "lat", "latitude"};
  for (const char* name : kNames) {
    const int field = feature.GetFieldIndex(name);
    if (field < 0) continue;
    const std::string text = feature.IsFieldSetAndNotNull(field) ? feature.GetFieldAsString(field) : "";
    char* end = nullptr;
    const double value = CPLStrtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(value))
      return text.empty() ? fmt::format("its {} is empty or not a number", name)
                          : fmt::format("its {} '{}' is not a number", name, text);
  }
  return {};
}

bool is_csv(GDALDataset& file) {
  return file.GetDriver() != nullptr && EQUAL(file.GetDriver()->GetDescription(), "CSV");
}

}  // namespace

GDALDatasetUniquePtr open_place_file(const std::string& path, ColumnTypes types) {
  // Only the CSV driver knows these names; other drivers pass them over.
  const char* const options[] = {"X_POSSIBLE_NAMES=x,easting,lon,longitude", "Y_POSSIBLE_NAMES=y,northing,lat,latitude",
                                 types == ColumnTypes::kTold ? "AUTODETECT_TYPE=YES" : nullptr, nullptr};
  return open_vector_file(path, options);
}

std::optional<CoordinateTransform> transform_of_places(OGRLayer& layer, const std::string& given_crs,
                                                       const std::string& to_crs) {
  const OGRSpatialReference* own = layer.GetSpatialRef();
  const std::string from_crs = own != nullptr ? wkt_of(*own) : given_crs;
  if (from_crs.empty() || from_crs == to_crs) return std::nullopt;
  return CoordinateTransform(from_crs, to_crs);
}

std::string read_place(GDALDataset& file, const OGRFeature& feature, Point2& place) {
  const bool csv = is_csv(file);
  if (csv)
    if (std::string wrong = wrong_coordinate(feature); !wrong.empty()) return wrong;
  const OGRGeometry* geometry = feature.GetGeometryRef();
  if (geometry == nullptr || geometry->IsEmpty())
    return csv ? "it has no point; a CSV file needs columns named x and y" : "it has no point";
  const OGRPoint* point = nullptr;
  if (wkbFlatten(geometry->getGeometryType()) == wkbPoint) point = geometry->toPoint();
  if (wkbFlatten(geometry->getGeometryType()) == wkbMultiPoint && geometry->toMultiPoint()->getNumGeometries() == 1)
    point = geometry->toMultiPoint()->getGeometryRef(0);
  if (point == nullptr) return fmt::format("it is a {}, not a point", geometry->getGeometryName());
  place = {point->getX(), point->getY()};
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) return "its position is not finite";
  return {};
}

}  // namespace itin
