// The backhaul: by which links each site reaches the hub.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "site/site_links.hpp"

namespace itin::cli {

/// A hop from one end of a network to another over a link; all are given by their numbers.
struct RouteHop {
  std::size_t from = 0, to = 0, link = 0;
};

/// A chosen or an existing site's route to the hub.
struct SiteRoute {
  std::size_t site = 0;        ///< an end of the network
  std::vector<RouteHop> hops;  ///< empty: the site does not reach the hub
};

/// Returns a route for each site, in the order of the network's ends; nothing without a hub. Routes go over links that
/// meet the rules and have the fewest hops, and among those the shortest length.
std::vector<SiteRoute> site_routes(const SiteOptions& options, const SiteNetwork& network);

double length_m(const SiteNetwork& network, const SiteRoute& route);
/// Returns "a → b → hub", or that there is no route.
std::string in_words(const SiteNetwork& network, const SiteRoute& route);
/// Returns the hop that leaves the least fraction of the first Fresnel zone clear; without a frequency, the hop of the
/// least clearance.
std::optional<RouteHop> worst_hop(const SiteNetwork& network, const SiteRoute& route);
/// Return how many routes go over each link, and through each end on the way from another site.
std::vector<std::size_t> routes_over_links(const SiteNetwork& network, const std::vector<SiteRoute>& routes);
std::vector<std::size_t> routes_through_ends(const SiteNetwork& network, const std::vector<SiteRoute>& routes);

}  // namespace itin::cli
