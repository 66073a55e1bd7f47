#include <algorithm>

#include <itin/feature_numbers.hpp>
#include <itin/parsed_number.hpp>

#include "store/feature_table.hpp"

namespace itin {

namespace {

std::optional<double> number_of(const AttributeValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* text = std::get_if<std::string>(&value)) return whole_text_as<double>(*text);
  return std::nullopt;
}

}  // namespace

std::vector<std::optional<double>> feature_numbers(const Store& store, std::uint16_t theme, const std::string& field) {
  const ThemeFeatures features = stored_features(store, theme);
  const auto named = std::find_if(features.fields.begin(), features.fields.end(),
                                  [&](const AttributeField& known) { return known.name == field; });
  std::vector<std::optional<double>> numbers;
  if (named == features.fields.end()) return numbers;
  const auto column = static_cast<std::size_t>(named - features.fields.begin());
  for (const FeatureRecord& record : features.records)
    numbers.push_back(column < record.values.size() ? number_of(record.values[column]) : std::nullopt);
  return numbers;
}

}  // namespace itin
