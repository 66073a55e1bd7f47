// Rasters of what the chosen and the existing sites serve.
#pragma once

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/site_plan.hpp>

#include "workflows/siting/joint_coverage.hpp"

namespace itin::viewshed {

/// Returns the levels that the sites give to the cells, whether these are served or not. Precondition: the request has
/// a link budget.
Result site_levels(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs, const Choice& choice,
                   const JointCoverage& cells, Progress& progress);

/// Returns the rasters of the cells that the sites serve. `levels` are these, or null.
SiteRasters site_rasters(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                         const Choice& choice, const JointCoverage& cells, const Result* levels, Progress& progress);

}  // namespace itin::viewshed
