// The backhaul: by which links each site reaches the hub.
#pragma once

#include <vector>

#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

/// Returns a route for each site, in the order of the network's ends; nothing without a hub.
std::vector<SiteRoute> site_routes(const SitePlanRequest& request, const SiteNetwork& network);

}  // namespace itin::viewshed
