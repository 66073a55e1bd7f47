// What maps of sites show above the cells: buildings, links, existing and chosen sites, the hub.
#pragma once

#include <vector>

#include <itin/store.hpp>
#include <viewshed/result_sheet.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::cli {

/// Returns the area of the cells, and of all sites and the hub with some ground about them.
Box shown_area(const viewshed::SitePlan& r);

/// Returns outlines of the buildings that screen, of the search area, of forbidden ground and of the ground too near to
/// dwellings, links, and marks for each kind of site. With a hub the links are
/// those on the routes to it; with links that hold the choice together but no hub, all links that meet the rules. Kinds
/// without an object are left out.
std::vector<viewshed::MapObjects> site_map_objects(const Store& store, const viewshed::SitePlan& r);

}  // namespace itin::cli
