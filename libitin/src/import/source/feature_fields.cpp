#include "import/source/feature_fields.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <ogrsf_frmts.h>

#include <itin/error.hpp>

#include "import/source/source_layer.hpp"

namespace itin {

namespace {

std::optional<AttributeType> attribute_type(OGRFieldType type) {
  switch (type) {
    case OFTInteger:
    case OFTInteger64:
      return AttributeType::whole;
    case OFTReal:
      return AttributeType::number;
    case OFTString:
    case OFTDate:
    case OFTTime:
    case OFTDateTime:
      return AttributeType::text;
    default:
      return std::nullopt;
  }
}

AttributeType wider(AttributeType a, AttributeType b) {
  if (a == b) return a;
  return a == AttributeType::text || b == AttributeType::text ? AttributeType::text : AttributeType::number;
}

void require_few(std::size_t fields, const std::string& path) {
  if (fields > kMostAttributes)
    throw InputError(fmt::format("{}: a theme keeps at most {} fields; name those to keep with `attributes`", path,
                                 kMostAttributes));
}

}  // namespace

FeatureQuery feature_query(const ImportOptions& options) {
  return {options.id_field, options.name_field, options.attributes};
}

FeatureFields::FeatureFields(OGRLayer& layer, std::string path, const FeatureQuery& query) : path_(std::move(path)) {
  if (!query.id_field.empty()) id_ = field_of_layer(layer, path_, query.id_field);
  if (!query.name_field.empty()) name_ = field_of_layer(layer, path_, query.name_field);
  if (query.attributes) {
    for (const std::string& name : *query.attributes) add(layer, field_of_layer(layer, path_, name), true);
  } else {
    for (int i = 0; i < layer.GetLayerDefn()->GetFieldCount(); ++i) add(layer, i, false);
  }
  require_few(fields_.size(), path_);
  keeps_ = !query.attributes || !query.attributes->empty() || id_ >= 0 || name_ >= 0;
}

void FeatureFields::add(OGRLayer& layer, int index, bool by_name) {
  const OGRFieldDefn& field = *layer.GetLayerDefn()->GetFieldDefn(index);
  const std::optional<AttributeType> type = attribute_type(field.GetType());
  if (type) {
    fields_.push_back({field.GetNameRef(), *type});
    indices_.push_back(index);
  } else if (by_name) {
    throw InputError(fmt::format("{}: field '{}' holds {}; `attributes` are numbers, texts, dates and times", path_,
                                 field.GetNameRef(), OGRFieldDefn::GetFieldTypeName(field.GetType())));
  }
}

std::string FeatureFields::text(const OGRFeature& feature, int index) const {
  if (!feature.IsFieldSetAndNotNull(index)) return {};
  std::string text = feature.GetFieldAsString(index);
  if (text.size() > kLongestText)
    throw InputError(
        fmt::format("{}: feature {}: {} has {} bytes, and at most {} are kept; name other fields with "
                    "`attributes`",
                    path_, feature.GetFID(), feature.GetFieldDefnRef(index)->GetNameRef(), text.size(), kLongestText));
  return text;
}

AttributeValue FeatureFields::value(const OGRFeature& feature, std::size_t field) const {
  const int index = indices_[field];
  if (!feature.IsFieldSetAndNotNull(index)) return {};
  switch (fields_[field].type) {
    case AttributeType::number:
      return feature.GetFieldAsDouble(index);
    case AttributeType::whole:
      return std::int64_t{feature.GetFieldAsInteger64(index)};
    default:
      return text(feature, index);
  }
}

FeatureRecord FeatureFields::record(const OGRFeature& feature) const {
  FeatureRecord record;
  record.id = id_ >= 0 ? text(feature, id_) : fmt::format("{}", feature.GetFID());
  if (name_ >= 0) record.name = text(feature, name_);
  for (std::size_t i = 0; i < fields_.size(); ++i) record.values.push_back(value(feature, i));
  return record;
}

std::vector<std::size_t> places_among(std::vector<AttributeField>& theme, const std::vector<AttributeField>& source,
                                      const std::string& path) {
  std::vector<std::size_t> places;
  for (const AttributeField& field : source) {
    auto found = std::find_if(theme.begin(), theme.end(), [&](const auto& f) { return f.name == field.name; });
    if (found == theme.end()) found = theme.insert(theme.end(), field);
    found->type = wider(found->type, field.type);
    places.push_back(static_cast<std::size_t>(found - theme.begin()));
  }
  require_few(theme.size(), path);
  return places;
}

FeatureRecord arranged(FeatureRecord record, const std::vector<std::size_t>& places) {
  std::vector<AttributeValue> values;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] >= values.size()) values.resize(places[i] + 1);
    values[places[i]] = std::move(record.values[i]);
  }
  record.values = std::move(values);
  return record;
}

}  // namespace itin
