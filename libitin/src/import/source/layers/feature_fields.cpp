#include "import/source/layers/feature_fields.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <ogrsf_frmts.h>

#include <itin/error.hpp>

#include "import/source/layers/source_layer.hpp"

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

std::string number_of(const OGRFeature& feature) {
  return fmt::format("feature {}", feature.GetFID());
}

}  // namespace

FeatureFields::FeatureFields(OGRLayer& layer, std::string path, FeatureQuery query)
    : path_(std::move(path)), query_(std::move(query)), texts_(path_), plain_(path_) {
  if (!query_.id_field.empty()) id_ = field_of_layer(layer, path_, query_.id_field);
  if (!query_.name_field.empty()) name_ = field_of_layer(layer, path_, query_.name_field);
  if (query_.attributes) {
    for (const std::string& name : *query_.attributes) add(layer, field_of_layer(layer, path_, name));
  } else {
    for (int i = 0; i < layer.GetLayerDefn()->GetFieldCount(); ++i) add(layer, i);
  }
  require_few_fields(fields_.size(), path_);
}

void FeatureFields::add(OGRLayer& layer, int index) {
  const OGRFieldDefn& field = *layer.GetLayerDefn()->GetFieldDefn(index);
  const std::string name = field.GetNameRef();
  const std::optional<AttributeType> type = attribute_type(field.GetType());
  const bool again = std::any_of(fields_.begin(), fields_.end(), [&](const auto& f) { return f.name == name; });
  if (query_.attributes && !type)
    throw InputError(fmt::format("{}: field '{}' holds {}; `attributes` are numbers, texts, dates and times", path_,
                                 name, OGRFieldDefn::GetFieldTypeName(field.GetType())),
                     "attributes");
  if (query_.attributes && again)
    throw InputError(fmt::format("{}: `attributes`: '{}' comes twice", path_, name), "attributes");
  if (again) warnings_.push_back(fmt::format("{}: has two fields '{}'; the first is kept", path_, name));
  if (!type)
    warnings_.push_back(fmt::format("{}: field '{}' is not kept: it holds {}", path_, name,
                                    OGRFieldDefn::GetFieldTypeName(field.GetType())));
  if (again || !type) return;
  fields_.push_back({name, *type});
  indices_.push_back(index);
}

std::string FeatureFields::text(const OGRFeature& feature, int index) {
  return feature.IsFieldSetAndNotNull(index) ? plain_.plain(feature.GetFieldAsString(index), number_of(feature)) : "";
}

AttributeValue FeatureFields::value(const OGRFeature& feature, std::size_t field) {
  const int index = indices_[field];
  if (!feature.IsFieldSetAndNotNull(index)) return {};
  switch (fields_[field].type) {
    case AttributeType::number:
      return feature.GetFieldAsDouble(index);
    case AttributeType::whole:
      return std::int64_t{feature.GetFieldAsInteger64(index)};
    default:
      return query_.attributes ? texts_.required(text(feature, index), number_of(feature), fields_[field].name)
                               : texts_.if_short(text(feature, index), number_of(feature), fields_[field].name);
  }
}

FeatureRecord FeatureFields::record(const OGRFeature& feature) {
  FeatureRecord record;
  const auto required = [&](int index, const std::string& field) {
    return texts_.required(text(feature, index), number_of(feature), field);
  };
  record.id = id_ >= 0 ? required(id_, query_.id_field) : fmt::format("{}", feature.GetFID());
  if (name_ >= 0) record.name = required(name_, query_.name_field);
  for (std::size_t i = 0; i < fields_.size(); ++i) record.values.push_back(value(feature, i));
  return record;
}

std::vector<std::string> FeatureFields::warnings() const {
  std::vector<std::string> lines = warnings_;
  for (std::string& line : texts_.warnings()) lines.push_back(std::move(line));
  for (std::string& line : plain_.warnings()) lines.push_back(std::move(line));
  return lines;
}

}  // namespace itin
