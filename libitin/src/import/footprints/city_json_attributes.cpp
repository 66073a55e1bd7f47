#include "import/footprints/city_json_attributes.hpp"

#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/error.hpp>

#include "import/footprints/city_json_values.hpp"

namespace itin {

namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kGreatestWhole = std::numeric_limits<std::int64_t>::max();

/// The type of a value; nothing for lists and objects.
std::optional<AttributeType> attribute_type_of(const Json& value) {
  if (value.is_string()) return AttributeType::text;
  if (value.is_number_float()) return AttributeType::number;
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > kGreatestWhole) return AttributeType::number;
  if (value.is_number() || value.is_boolean()) return AttributeType::whole;
  return std::nullopt;
}

std::string as_text(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

CityJsonAttributes::CityJsonAttributes(std::string path, FeatureQuery query)
    : path_(std::move(path)), query_(std::move(query)), texts_(path_) {}

void CityJsonAttributes::note(const Json& building) {
  member_or_empty(building, "parents", Json::value_t::array);
  for (const auto& [name, value] : member_or_empty(building, "attributes", Json::value_t::object).items()) {
    if (value.is_null()) continue;
    const std::optional<AttributeType> own = attribute_type_of(value);
    const auto [known, fresh] = types_.try_emplace(name, own);
    if (!fresh) known->second = known->second && own ? std::optional(wider(*known->second, *own)) : std::nullopt;
  }
}

AttributeType CityJsonAttributes::type_of(const std::string& name) const {
  const auto found = types_.find(name);
  if (found == types_.end()) {
    std::vector<std::string> names;
    for (const auto& [known, type] : types_) names.push_back(known);
    throw FileError(path_, fmt::format("no building has an attribute '{}'; they have {}", name, names));
  }
  if (!found->second)
    throw InputError(
        fmt::format("{}: attribute '{}' holds lists or objects; `attributes` are numbers, texts and truth values",
                    path_, name),
        "attributes");
  return *found->second;
}

void CityJsonAttributes::finish(const CityObjects& objects) {
  objects_ = &objects;
  for (const std::string& name : {query_.id_field, query_.name_field})
    if (!name.empty()) type_of(name);
  if (query_.attributes) {
    for (const std::string& name : *query_.attributes) fields_.push_back({name, type_of(name)});
  } else {
    for (const auto& [name, type] : types_) {
      if (type)
        fields_.push_back({name, *type});
      else
        left_out_.push_back(name);
    }
  }
  require_few_fields(fields_.size(), path_);
}

/// The object's own attribute, else that of one of its parents; null if there is none.
const Json* CityJsonAttributes::attribute(const std::string& key, const std::string& name) const {
  const auto own_of = [&](const std::string& object) -> const Json* {
    const auto found = objects_->find(object);
    if (found == objects_->end()) return nullptr;
    const Json& attributes = member_or_empty(*found->second, "attributes", Json::value_t::object);
    const auto value = attributes.find(name);
    return value == attributes.end() || value->is_null() ? nullptr : &*value;
  };
  if (const Json* own = own_of(key)) return own;
  for (const Json& parent : member_or_empty(*objects_->at(key), "parents", Json::value_t::array))
    if (const Json* of_parent = parent.is_string() ? own_of(parent.get<std::string>()) : nullptr) return of_parent;
  return nullptr;
}

std::string CityJsonAttributes::text(const std::string& key, const std::string& name) const {
  const Json* found = attribute(key, name);
  return found != nullptr ? texts_.required(as_text(*found), key, name) : "";
}

AttributeValue CityJsonAttributes::value(const std::string& key, const AttributeField& field) {
  const Json* found = attribute(key, field.name);
  if (found == nullptr) return {};
  switch (field.type) {
    case AttributeType::number:
      return found->is_boolean() ? static_cast<double>(found->get<bool>()) : found->get<double>();
    case AttributeType::whole:
      return found->is_boolean() ? std::int64_t{found->get<bool>()} : found->get<std::int64_t>();
    default:
      return query_.attributes ? texts_.required(as_text(*found), key, field.name)
                               : texts_.if_short(as_text(*found), key, field.name);
  }
}

std::vector<std::string> CityJsonAttributes::warnings() const {
  std::vector<std::string> lines = texts_.warnings();
  if (!left_out_.empty())
    lines.push_back(
        fmt::format("{}: attributes that hold lists or objects are not kept: {}", path_, fmt::join(left_out_, ", ")));
  return lines;
}

FeatureRecord CityJsonAttributes::record(const std::string& key) {
  FeatureRecord record;
  if (!query_.id_field.empty()) record.id = text(key, query_.id_field);
  if (record.id.empty()) record.id = key;
  if (!query_.name_field.empty()) record.name = text(key, query_.name_field);
  for (const AttributeField& field : fields_) record.values.push_back(value(key, field));
  return record;
}

}  // namespace itin
