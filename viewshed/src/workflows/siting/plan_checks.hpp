// Whether a request for sites makes sense and fits into its memory, and what to beware of in its result.
#pragma once

#include <itin/store.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

/// Throws InputError for fields that make no sense, by themselves or together. check_goal() checks the rest.
void check(const SitePlanRequest& request);

/// Checks that the memory holds maps of the rasters besides the bounds of all sites. Where demand is points, the
/// rasters are of cells about the sites. Throws InputError.
void require_memory(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs);

/// Checks that there are as many candidates as turbines; distances between candidates are not considered yet. Throws
/// Error.
void require_enough(const SitePlanRequest& request, const SiteInputs& inputs);

/// Adds a line to the plan's warnings for each thing to beware of in its result.
void add_warnings(const Store& store, SitePlan& plan);

}  // namespace itin::viewshed
