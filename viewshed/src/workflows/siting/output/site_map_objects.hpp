// What maps of sites show above the cells: buildings, areas, links, points of the demand, sites, the hub.
#pragma once

#include <vector>

#include <itin/store.hpp>
#include <viewshed/result_sheet.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

/// Returns the area of the cells, and of all sites and the hub with some ground about them.
Box shown_area(const SitePlan& plan);

/// Returns outlines of the buildings that screen, of the search area, of forbidden ground and of the ground too near to
/// dwellings, links, points of the demand, and marks for each kind of site. With a hub the links are
/// those on the routes to it; with links that hold the choice together but no hub, all links that meet the rules. Kinds
/// without an object are left out.
std::vector<MapObjects> site_map_objects(const Store& store, const SitePlan& plan);

}  // namespace itin::viewshed
