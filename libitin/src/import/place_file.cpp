#include "import/place_file.hpp"

#include <array>
#include <cmath>

#include <cpl_vsi.h>
#include <fmt/format.h>

#include <itin/error.hpp>

#include "import/quiet_gdal.hpp"

namespace itin {

namespace {

std::string why_not_open(const std::string& path) {
  VSIStatBufL status;
  if (VSIStatL(path.c_str(), &status) != 0) return "there is no such file";
  if (status.st_size == 0) return "is empty";
  return "not readable as a vector file (" + QuietGdal::message("GDAL knows no such format") + ")";
}

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
  GDALDatasetUniquePtr file(
      GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, options, nullptr));
  if (!file) throw FileError(path, why_not_open(path));
  return file;
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
