// What maps of sites show above the cells: buildings, links, existing and chosen sites, the hub.
#pragma once

#include <vector>

#include <itin/store.hpp>

#include "output/result_sheet.hpp"
#include "site/site_result.hpp"

namespace itin::cli {

/// The cells, and all sites and the hub with some ground about them.
Box shown_area(const SiteResult& result);

/// Outlines of the buildings that screen; with a hub the links of the routes to it, and with links that hold the choice
/// together but no hub all links that may; marks by what a site is. Kinds of which there are none are left out.
std::vector<MapObjects> site_map_objects(const Store& store, const SiteResult& result);

}  // namespace itin::cli
