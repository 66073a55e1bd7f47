// The demand of a choice of sites: cells in reach of the candidates, a raster of weights, or points.
#pragma once

#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

/// Adds the demand to inputs that have their options and positions. Throws InputError where there is no demand.
void add_demand(const Store& store, const SitePlanRequest& request, SiteInputs& inputs,
                std::vector<std::string>& warnings, Progress& progress);

}  // namespace itin::viewshed
