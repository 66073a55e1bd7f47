#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/position_columns.hpp>
#include <itin/site_list.hpp>

namespace itin {

namespace {

/// Warns of fields that seem to hold heights, in a file that has no kHeightField.
void warn_of_likely_heights(const SiteQuery& query, const LayerFields& fields, const HeightChoice& choice,
                            std::vector<std::string>& warnings) {
  std::vector<std::string> likely;
  for (const std::string& field : fields.names())
    if (may_hold_heights(field) && std::find(choice.used.begin(), choice.used.end(), field) == choice.used.end())
      likely.push_back(field);
  if (likely.empty()) return;
  const std::string advice = choice.field_option.empty() ? fmt::format("call it '{}'", kHeightField)
                                                         : fmt::format("name it with {}", choice.field_option);
  warnings.push_back(fmt::format("{}: it has no field '{}'; no heights are taken from '{}'; if one holds them, {}",
                                 query.path, kHeightField, fmt::join(likely, "', '"), advice));
}

}  // namespace

void take_heights(SiteQuery& query, const LayerFields& fields, const HeightChoice& choice,
                  std::vector<std::string>& warnings) {
  if (!query.height_field.empty()) return;
  const std::optional<std::string> field = fields.named(kHeightField);
  if (!choice.given.empty()) {
    if (field)
      warnings.push_back(
          fmt::format("{}: the heights in its field '{}' are not used: {} comes before them; to use them leave it out",
                      query.path, *field, choice.given));
  } else if (field) {
    query.height_field = *field;
  } else {
    warn_of_likely_heights(query, fields, choice, warnings);
  }
}

std::optional<std::string> name_field_of(const LayerFields& fields) {
  if (const auto field = fields.named(kNameField)) return field;
  const auto first = std::find_if(fields.names().begin(), fields.names().end(), may_hold_names);
  if (first == fields.names().end() ||
      std::find_if(first + 1, fields.names().end(), may_hold_names) != fields.names().end())
    return std::nullopt;
  return *first;
}

void take_names(SiteQuery& query, const LayerFields& fields) {
  if (query.name_field.empty()) query.name_field = name_field_of(fields).value_or("");
}

void warn_of_unused(const SiteQuery& query, const LayerFields& fields, const std::string& field,
                    const std::string& option, std::vector<std::string>& warnings) {
  if (const auto there = fields.named(field))
    warnings.push_back(
        fmt::format("{}: its field '{}' is not used; {} {} would use it", query.path, *there, option, *there));
}

std::string none_in(const SiteQuery& query, const char* what) {
  return fmt::format("{}: holds no {}{}", query.path, what,
                     query.where.empty() ? "" : fmt::format(" for which `where` '{}' holds", query.where));
}

}  // namespace itin
