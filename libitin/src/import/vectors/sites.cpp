#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/decimal_comma.hpp>
#include <itin/error.hpp>
#include <itin/height_limit.hpp>
#include <itin/sites.hpp>

#include "gdal/quiet_gdal.hpp"
#include "import/source/source_layer.hpp"
#include "import/vectors/place_file.hpp"

namespace itin {

namespace {

/// The index of a field; -1 if none is asked for.
int field_index(OGRLayer& layer, const std::string& path, const std::string& name) {
  return name.empty() ? -1 : field_of_layer(layer, path, name);
}

/// The number in a field; nothing for an empty field, and not a number for one that holds something else.
std::optional<double> number_of_field(const OGRFeature& feature, int field) {
  if (!feature.IsFieldSetAndNotNull(field)) return std::nullopt;
  const OGRFieldType type = feature.GetFieldDefnRef(field)->GetType();
  if (type == OFTInteger || type == OFTInteger64 || type == OFTReal) return feature.GetFieldAsDouble(field);
  const std::string text = with_decimal_point(feature.GetFieldAsString(field));
  if (text.empty()) return std::nullopt;
  char* end = nullptr;
  const double value = CPLStrtod(text.c_str(), &end);
  return *end != '\0' ? std::numeric_limits<double>::quiet_NaN() : value;
}

std::optional<double> height_of(const OGRFeature& feature, int field, const std::string& place) {
  const std::optional<double> height = number_of_field(feature, field);
  if (!height) return std::nullopt;
  const char* const name = feature.GetFieldDefnRef(field)->GetNameRef();
  if (!std::isfinite(*height)) throw FileError(place, fmt::format("its height field '{}' holds no number", name));
  require_height(*height, fmt::format("{}: field '{}'", place, name));
  return height;
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
    numbers.push_back(field < 0 ? std::nullopt : number_of_field(feature, field));
    if (numbers.back() && !std::isfinite(*numbers.back()))
      throw FileError(place,
                      fmt::format("its field '{}' holds no number", feature.GetFieldDefnRef(field)->GetNameRef()));
  }
  return numbers;
}

/// The fields of a layer that sites take their values from; -1 if none is asked for.
struct SiteFields {
  int height, name;
  std::vector<int> numbers;
};

Site site_of(const Places& places, const OGRFeature& feature, const SiteFields& fields, const std::string& place) {
  Site site;
  site.feature = feature.GetFID();
  site.name = fields.name < 0 ? std::to_string(site.feature) : feature.GetFieldAsString(fields.name);
  const std::string wrong = places.find(feature, site.position);
  if (!wrong.empty()) throw FileError(place, wrong);
  if (fields.height >= 0) site.height = height_of(feature, fields.height, place);
  site.numbers = numbers_of(feature, fields.numbers, place);
  return site;
}

/// Reads sites. If `rejected` is null, the first feature that is not understood ends the reading.
std::vector<Site> read(const SiteQuery& query, const std::string& to_crs, std::vector<std::string>* rejected) {
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = open_place_file(query.path, ColumnTypes::kDeclared);
  OGRLayer& layer = choose_layer(*dataset, query.path, query.layer);
  const SiteFields fields{field_index(layer, query.path, query.height_field),
                          field_index(layer, query.path, query.name_field), number_fields(layer, query)};
  select_features(layer, query.path, query.where);
  const Places places(*dataset, layer, query, to_crs);

  std::vector<Site> sites;
  std::int64_t row = 0;
  while (const OGRFeatureUniquePtr feature = next_feature(layer, query.path)) {
    const std::string place = fmt::format("{}: feature {}", query.path, feature->GetFID());
    try {
      sites.push_back(site_of(places, *feature, fields, place));
      sites.back().row = row++;
    } catch (const Error& error) {
      if (rejected == nullptr) throw;
      rejected->push_back(error.what());
      ++row;
    }
  }
  return sites;
}

}  // namespace

LayerFields::LayerFields(const SiteQuery& query) {
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = open_place_file(query.path, ColumnTypes::kDeclared);
  const OGRFeatureDefn& layer = *choose_layer(*dataset, query.path, query.layer).GetLayerDefn();
  for (int i = 0; i < layer.GetFieldCount(); ++i) names_.emplace_back(layer.GetFieldDefn(i)->GetNameRef());
}

bool LayerFields::has(const std::string& name) const {
  return std::any_of(names_.begin(), names_.end(),
                     [&](const std::string& field) { return EQUAL(field.c_str(), name.c_str()); });
}

std::vector<Site> read_sites(const SiteQuery& query, const std::string& to_crs) {
  return read(query, to_crs, nullptr);
}

std::vector<Site> read_sites(const SiteQuery& query, const std::string& to_crs, std::vector<std::string>& rejected) {
  return read(query, to_crs, &rejected);
}

}  // namespace itin
