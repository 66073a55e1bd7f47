// Rasters of what the chosen and the existing sites serve.
#pragma once

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/site_plan.hpp>

#include "workflows/siting/joint_coverage.hpp"

namespace itin::viewshed {

/// Returns the rasters of the cells that the sites serve.
SiteRasters site_rasters(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                         const Choice& choice, const JointCoverage& cells, Progress& progress);

}  // namespace itin::viewshed
