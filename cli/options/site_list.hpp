// The error about a file of places that holds none.
#pragma once

#include <string>

#include <fmt/format.h>

#include <itin/sites.hpp>

namespace itin::cli {

/// Names the option that may have left all out, where there is one.
inline std::string none_in(const SiteQuery& query, const char* what) {
  return fmt::format("{}: holds no {}{}", query.path, what,
                     query.where.empty() ? "" : fmt::format(" for which --where '{}' holds", query.where));
}

}  // namespace itin::cli
