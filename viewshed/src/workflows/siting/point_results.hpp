// What the chosen and the existing masts are to each point of the demand.
#pragma once

#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/site_plan.hpp>

#include "workflows/siting/joint_coverage.hpp"

namespace itin::viewshed {

/// Returns a result for each point, in the order in which they were given. Who serves a point is what `coverage`, that
/// of the demand, says. Throws Cancelled, CorruptStore, FileError.
std::vector<PointResult> point_results(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                                       const Choice& choice, const JointCoverage& coverage, Progress& progress);

}  // namespace itin::viewshed
