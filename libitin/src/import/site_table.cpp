#include <array>
#include <cmath>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/site_table.hpp>

#include "import/crs.hpp"
#include "import/quiet_gdal.hpp"
#include "import/vector_layer.hpp"

namespace itin {

namespace {

GDALDatasetUniquePtr opened(const std::string& path) {
  // Only the CSV driver knows these names; other drivers pass them over. Types are left alone: a bad row must not turn
  // a column of numbers into one of texts.
  const char* const options[] = {"X_POSSIBLE_NAMES=x,easting,lon,longitude", "Y_POSSIBLE_NAMES=y,northing,lat,latitude",
                                 nullptr};
  GDALDatasetUniquePtr dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, options, nullptr));
  if (!dataset)
    throw FileError(path, "not readable as a vector file (" + QuietGdal::message("GDAL knows no such format") + ")");
  return dataset;
}

/// GDAL reads a coordinate that is no number as 0.
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

class RowReader {
 public:
  RowReader(OGRLayer& layer, const SiteQuery& query, const std::vector<std::string>& fields, const std::string& to_crs,
            bool coordinates_are_fields)
      : coordinates_are_fields_(coordinates_are_fields) {
    for (const std::string& name : fields) fields_.push_back(layer.GetLayerDefn()->GetFieldIndex(name.c_str()));
    std::string from_crs = query.crs;
    if (const OGRSpatialReference* own = layer.GetSpatialRef()) from_crs = wkt_of(*own);
    if (!from_crs.empty() && from_crs != to_crs) transform_.emplace(from_crs, to_crs);
  }

  SiteRow read(const OGRFeature& feature) const {
    SiteRow row;
    row.feature = feature.GetFID();
    for (const int field : fields_) {
      const bool present =
          field >= 0 && feature.IsFieldSetAndNotNull(field) && *feature.GetFieldAsString(field) != '\0';
      row.values.push_back(present ? std::optional<std::string>(feature.GetFieldAsString(field)) : std::nullopt);
    }
    row.error = place(feature, row.position);
    if (!row.error.empty()) row.position.reset();
    return row;
  }

 private:
  std::string place(const OGRFeature& feature, std::optional<Point2>& position) const {
    if (coordinates_are_fields_)
      if (std::string wrong = wrong_coordinate(feature); !wrong.empty()) return wrong;
    const OGRGeometry* geometry = feature.GetGeometryRef();
    if (geometry == nullptr || geometry->IsEmpty()) return "it has no point; a CSV file needs columns named x and y";
    const OGRPoint* point = nullptr;
    if (wkbFlatten(geometry->getGeometryType()) == wkbPoint) point = geometry->toPoint();
    if (wkbFlatten(geometry->getGeometryType()) == wkbMultiPoint && geometry->toMultiPoint()->getNumGeometries() == 1)
      point = geometry->toMultiPoint()->getGeometryRef(0);
    if (point == nullptr) return fmt::format("it is a {}, not a point", geometry->getGeometryName());
    position = Point2{point->getX(), point->getY()};
    if (!std::isfinite(position->x) || !std::isfinite(position->y)) return "its position is not finite";
    try {
      if (transform_) position = (*transform_)(*position);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  std::vector<int> fields_;
  std::optional<CoordinateTransform> transform_;
  bool coordinates_are_fields_;
};

}  // namespace

std::vector<SiteRow> read_site_rows(const SiteQuery& query, const std::vector<std::string>& fields,
                                    const std::string& to_crs) {
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = opened(query.path);
  OGRLayer& layer = choose_layer(*dataset, query.path, query.layer);
  if (!query.where.empty()) select_features(layer, query.path, query.where);
  const bool csv = dataset->GetDriver() != nullptr && EQUAL(dataset->GetDriver()->GetDescription(), "CSV");
  const RowReader reader(layer, query, fields, to_crs, csv);
  std::vector<SiteRow> rows;
  for (const OGRFeatureUniquePtr& feature : layer) rows.push_back(reader.read(*feature));
  return rows;
}

}  // namespace itin
