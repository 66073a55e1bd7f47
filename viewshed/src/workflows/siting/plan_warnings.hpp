// What to beware of in a choice of sites.
#pragma once

#include <itin/store.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

/// Adds a line to the plan's warnings for each thing to beware of in its result.
void add_warnings(const Store& store, SitePlan& plan);

}  // namespace itin::viewshed
