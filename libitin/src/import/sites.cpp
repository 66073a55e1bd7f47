#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/sites.hpp>

#include "import/crs.hpp"
#include "import/quiet_gdal.hpp"

namespace itin {

namespace {

GDALDatasetUniquePtr opened(const std::string& path) {
  // Only the CSV driver knows these names; other drivers pass them over.
  const char* const options[] = {"X_POSSIBLE_NAMES=x,easting,lon,longitude", "Y_POSSIBLE_NAMES=y,northing,lat,latitude",
                                 "AUTODETECT_TYPE=YES", nullptr};
  GDALDatasetUniquePtr dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, options, nullptr));
  if (!dataset) {
    throw FileError(path, "not readable as a vector file (" + QuietGdal::message("GDAL knows no such format") + ")");
  }
  return dataset;
}

OGRLayer& chosen_layer(GDALDataset& dataset, const SiteQuery& query) {
  if (!query.layer.empty()) {
    OGRLayer* layer = dataset.GetLayerByName(query.layer.c_str());
    if (layer == nullptr) throw FileError(query.path, fmt::format("no layer '{}'; see ogrinfo", query.layer));
    return *layer;
  }
  if (dataset.GetLayerCount() != 1) {
    throw FileError(query.path, fmt::format("has {} layers; choose one with --layer", dataset.GetLayerCount()));
  }
  return *dataset.GetLayer(0);
}

/// The index of a field, or -1 if none is asked for.
int field_index(OGRLayer& layer, const std::string& path, const std::string& name) {
  if (name.empty()) return -1;
  const int index = layer.GetLayerDefn()->GetFieldIndex(name.c_str());
  if (index < 0) throw FileError(path, fmt::format("layer '{}' has no field '{}'", layer.GetName(), name));
  return index;
}

/// Empty when the layer is in the wanted CRS already.
std::optional<CoordinateTransform> transform_from(OGRLayer& layer, const SiteQuery& query, const std::string& to_crs) {
  std::string from_crs = query.crs;
  if (const OGRSpatialReference* own = layer.GetSpatialRef()) from_crs = wkt_of(*own);
  if (from_crs.empty() || from_crs == to_crs) return std::nullopt;
  return CoordinateTransform(from_crs, to_crs);
}

/// Nothing for an empty field; not a number for one that holds something else.
std::optional<double> number_in(const OGRFeature& feature, int field) {
  if (!feature.IsFieldSetAndNotNull(field)) return std::nullopt;
  const OGRFieldType type = feature.GetFieldDefnRef(field)->GetType();
  if (type == OFTInteger || type == OFTInteger64 || type == OFTReal) return feature.GetFieldAsDouble(field);
  char* end = nullptr;
  const char* text = feature.GetFieldAsString(field);
  if (*text == '\0') return std::nullopt;
  const double value = CPLStrtod(text, &end);
  return *end != '\0' ? std::numeric_limits<double>::quiet_NaN() : value;
}

double height_of(const OGRFeature& feature, int field, const std::string& place) {
  const std::optional<double> height = number_in(feature, field);
  if (!height || !std::isfinite(*height))
    throw FileError(place,
                    fmt::format("its height field '{}' holds no number", feature.GetFieldDefnRef(field)->GetNameRef()));
  return *height;
}

std::vector<int> number_fields(OGRLayer& layer, const SiteQuery& query) {
  std::vector<int> fields;
  for (const NumberField& field : query.numbers) {
    const bool absent = layer.GetLayerDefn()->GetFieldIndex(field.name.c_str()) < 0;
    fields.push_back(absent && !field.required ? -1 : field_index(layer, query.path, field.name));
  }
  return fields;
}

std::vector<std::optional<double>> numbers_of(const OGRFeature& feature, const std::vector<int>& fields,
                                              const std::string& place) {
  std::vector<std::optional<double>> numbers;
  for (const int field : fields) {
    numbers.push_back(field < 0 ? std::nullopt : number_in(feature, field));
    if (numbers.back() && !std::isfinite(*numbers.back()))
      throw FileError(place,
                      fmt::format("its field '{}' holds no number", feature.GetFieldDefnRef(field)->GetNameRef()));
  }
  return numbers;
}

Point2 position_of(const OGRFeature& feature, const std::string& place) {
  const OGRGeometry* geometry = feature.GetGeometryRef();
  if (geometry == nullptr || geometry->IsEmpty()) {
    throw FileError(place, "has no point; a CSV file needs columns named x and y");
  }
  const OGRPoint* point = nullptr;
  if (wkbFlatten(geometry->getGeometryType()) == wkbPoint) point = geometry->toPoint();
  if (wkbFlatten(geometry->getGeometryType()) == wkbMultiPoint && geometry->toMultiPoint()->getNumGeometries() == 1) {
    point = geometry->toMultiPoint()->getGeometryRef(0);
  }
  if (point == nullptr) throw FileError(place, fmt::format("is a {}, not a point", geometry->getGeometryName()));
  return {point->getX(), point->getY()};
}

}  // namespace

std::vector<Site> read_sites(const SiteQuery& query, const std::string& to_crs) {
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = opened(query.path);
  OGRLayer& layer = chosen_layer(*dataset, query);
  const int height_field = field_index(layer, query.path, query.height_field);
  const int name_field = field_index(layer, query.path, query.name_field);
  const std::vector<int> further_fields = number_fields(layer, query);
  if (!query.where.empty() && layer.SetAttributeFilter(query.where.c_str()) != OGRERR_NONE) {
    throw FileError(query.path, fmt::format("--where '{}': {}", query.where, QuietGdal::message("not understood")));
  }
  const std::optional<CoordinateTransform> transform = transform_from(layer, query, to_crs);

  std::vector<Site> sites;
  for (const OGRFeatureUniquePtr& feature : layer) {
    const std::string place = fmt::format("{}: feature {}", query.path, feature->GetFID());
    Site site;
    site.feature = feature->GetFID();
    site.name = name_field < 0 ? std::to_string(site.feature) : feature->GetFieldAsString(name_field);
    site.position = position_of(*feature, place);
    if (height_field >= 0) site.height = height_of(*feature, height_field, place);
    site.numbers = numbers_of(*feature, further_fields, place);
    try {
      if (transform) site.position = (*transform)(site.position);
    } catch (const InputError& error) {
      throw FileError(place, error.what());
    }
    sites.push_back(std::move(site));
  }
  return sites;
}

}  // namespace itin
