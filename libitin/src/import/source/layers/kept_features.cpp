#include "import/source/layers/kept_features.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin {

FeatureQuery feature_query(const ImportOptions& options) {
  if (options.attributes) {
    std::vector<std::string> names = *options.attributes;
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end()) throw InputError(fmt::format("`attributes`: '{}' comes twice", *twice), "attributes");
  }
  return {options.id_field, options.name_field, options.attributes};
}

AttributeType wider(AttributeType a, AttributeType b) {
  if (a == b) return a;
  return a == AttributeType::text || b == AttributeType::text ? AttributeType::text : AttributeType::number;
}

void require_few_fields(std::size_t fields, const std::string& path) {
  if (fields > kMostAttributes)
    throw InputError(
        fmt::format("{}: a theme keeps at most {} fields; name those to keep with `attributes`", path, kMostAttributes),
        "attributes");
}

std::string KeptTexts::required(std::string text, const std::string& feature, const std::string& field) const {
  if (text.size() > kLongestText)
    throw InputError(fmt::format("{}: {}: {} has {} bytes, and at most {} are kept; name another field", path_, feature,
                                 field, text.size(), kLongestText));
  return text;
}

AttributeValue KeptTexts::if_short(std::string text, const std::string& feature, const std::string& field) {
  if (text.size() <= kLongestText) return text;
  if (left_out_++ == 0) first_ = fmt::format("{} of {}", field, feature);
  return {};
}

std::vector<std::string> KeptTexts::warnings() const {
  if (left_out_ == 0) return {};
  return {fmt::format("{}: {} with more than {} bytes {} not kept: {}{}", path_, left_out_ == 1 ? "a text" : "texts",
                      kLongestText, left_out_ == 1 ? "is" : "are", first_,
                      left_out_ == 1 ? "" : fmt::format(" and {} more", left_out_ - 1))};
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
  require_few_fields(theme.size(), path);
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
