// Lines of sight between sites: between the chosen ones for the report, and those that hold a choice together; and the
// routes over them to the hub.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

/// Returns the network of the choice with its lines.
SiteNetwork site_network(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                         const Choice& choice, const std::optional<SitePosition>& hub, Progress& progress);

/// Returns the links among options, existing sites and the hub that meet the rules. They refer to the store and the
/// progress.
std::shared_ptr<LinkNetwork> link_network(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                                          const std::optional<SitePosition>& hub, Progress& progress);

/// Returns a route for each site, in the order of the network's ends; nothing without a hub.
std::vector<SiteRoute> site_routes(const SitePlanRequest& request, const SiteNetwork& network);

}  // namespace itin::viewshed
