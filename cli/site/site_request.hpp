// The request of a siting run, completed by what its files hold.
#pragma once

#include <itin/store.hpp>
#include <viewshed/site_plan.hpp>

#include "site/site_options.hpp"

namespace itin::cli {

/// Reads candidates, existing sites, areas, dwellings and demand. To be called after SiteOptions::take_fields(). Throws
/// InputError, FileError.
viewshed::SitePlanRequest complete_request(const SiteOptions& options, const StoreMetadata& metadata);

}  // namespace itin::cli
