// What to beware of in the result of a siting run.
#pragma once

#include <string>
#include <vector>

#include <itin/store.hpp>

#include "site/site_result.hpp"

namespace itin::cli {

/// Adds a line to `warnings` for each thing to beware of.
void warn_of(const SiteResult& site, const Store& store, std::vector<std::string>& warnings);

}  // namespace itin::cli
