#include "options/site_list.hpp"

#include <fmt/format.h>

namespace itin::cli {

void take_heights(SiteQuery& query, const LayerFields& fields, const std::string& given,
                  std::vector<std::string>& warnings) {
  if (!query.height_field.empty() || !fields.has(kHeightField)) return;
  if (!given.empty()) {
    warnings.push_back(
        fmt::format("{}: the heights in its field '{}' are not used: {} comes before them; to use them leave it out",
                    query.path, kHeightField, given));
  } else {
    query.height_field = kHeightField;
  }
}

void take_names(SiteQuery& query, const LayerFields& fields) {
  if (query.name_field.empty() && fields.has(kNameField)) query.name_field = kNameField;
}

void warn_of_unused(const SiteQuery& query, const LayerFields& fields, const std::string& field,
                    const std::string& option, std::vector<std::string>& warnings) {
  if (fields.has(field))
    warnings.push_back(
        fmt::format("{}: its field '{}' is not used; {} {} would use it", query.path, field, option, field));
}

std::string none_in(const SiteQuery& query, const char* what) {
  return fmt::format("{}: holds no {}{}", query.path, what,
                     query.where.empty() ? "" : fmt::format(" for which --where '{}' holds", query.where));
}

}  // namespace itin::cli
