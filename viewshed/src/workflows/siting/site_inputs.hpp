// A request's candidates, existing sites and demand, as checked and placed on their ground.
#pragma once

#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

/// Understands the request. `warnings` gets a line for each thing that may not be what was meant. Throws InputError
/// where no candidate is left to choose from, or there is no demand.
SiteInputs understood(const Store& store, const SitePlanRequest& request, std::vector<std::string>& warnings,
                      Progress& progress);

}  // namespace itin::viewshed
