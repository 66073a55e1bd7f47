#include "options/site_list.hpp"

#include <fmt/format.h>

namespace itin::cli {

void take_heights(SiteQuery& query, const std::string& given, std::vector<std::string>& warnings) {
  if (!query.height_field.empty() || !has_field(query, kHeightField)) return;
  if (!given.empty()) {
    warnings.push_back(
        fmt::format("{}: the heights in its field '{}' are not used: {} comes before them; to use them leave it out",
                    query.path, kHeightField, given));
  } else {
    query.height_field = kHeightField;
  }
}

void take_names(SiteQuery& query) {
  if (query.name_field.empty() && has_field(query, kNameField)) query.name_field = kNameField;
}

void warn_of_unused(const SiteQuery& query, const std::string& field, const std::string& option,
                    std::vector<std::string>& warnings) {
  if (has_field(query, field))
    warnings.push_back(
        fmt::format("{}: its field '{}' is not used; {} {} would use it", query.path, field, option, field));
}

std::string none_in(const SiteQuery& query, const char* what) {
  return fmt::format("{}: holds no {}{}", query.path, what,
                     query.where.empty() ? "" : fmt::format(" for which --where '{}' holds", query.where));
}

}  // namespace itin::cli
