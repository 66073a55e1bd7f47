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

/// Adds the demand to inputs that have their options and positions: cells in reach of these, a grid of weights, or
/// points. Throws InputError where there is no demand.
void add_demand(const Store& store, const SitePlanRequest& request, SiteInputs& inputs,
                std::vector<std::string>& warnings, Progress& progress);

}  // namespace itin::viewshed
