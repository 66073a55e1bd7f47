// The backhaul: by which links each site reaches the hub.

#include <limits>

#include <viewshed/site_links.hpp>

#include "workflows/siting/shortest_routes.hpp"
#include "workflows/siting/site_network.hpp"

namespace itin::viewshed {

std::vector<SiteRoute> site_routes(const SitePlanRequest& request, const SiteNetwork& network) {
  if (!request.hub) return {};
  const LinkRules rules = link_rules(request);
  std::vector<RouteLink> usable;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < network.links.size(); ++i) {
    const SiteLink& link = network.links[i];
    if (!rules.met_by(link.found())) continue;
    usable.push_back({link.from, link.to, link.line.distance_m});
    numbers.push_back(i);
  }
  const std::size_t hub = network.ends.size() - 1;
  const auto leaves_by = shortest_routes(hub, network.ends.size(), usable);
  std::vector<SiteRoute> routes;
  for (std::size_t site = 0; site < hub; ++site) {
    routes.push_back({site, {}});
    for (std::size_t at = site; leaves_by[at];) {
      const std::size_t next = usable[*leaves_by[at]].other_end(at);
      routes.back().hops.push_back({at, next, numbers[*leaves_by[at]]});
      at = next;
    }
  }
  return routes;
}

double length_m(const SiteNetwork& network, const SiteRoute& route) {
  double sum = 0;
  for (const RouteHop& hop : route.hops) sum += network.links[hop.link].line.distance_m;
  return sum;
}

std::string in_words(const SiteNetwork& network, const SiteRoute& route) {
  if (route.hops.empty()) return "no route to the hub";
  std::string text = network.ends[route.site].place.name;
  for (const RouteHop& hop : route.hops) text += " \xE2\x86\x92 " + network.ends[hop.to].place.name;
  return text;
}

std::optional<RouteHop> worst_hop(const SiteNetwork& network, const SiteRoute& route) {
  std::optional<RouteHop> worst;
  double least = std::numeric_limits<double>::infinity();
  for (const RouteHop& hop : route.hops) {
    const profile::LineFindings& found = network.links[hop.link].found();
    const double left = found.fresnel       ? found.fresnel->fraction
                        : found.clearance_m ? *found.clearance_m
                                            : std::numeric_limits<double>::infinity();
    if (left < least) least = left, worst = hop;
  }
  return worst;
}

std::vector<std::size_t> routes_over_links(const SiteNetwork& network, const std::vector<SiteRoute>& routes) {
  std::vector<std::size_t> count(network.links.size());
  for (const SiteRoute& route : routes)
    for (const RouteHop& hop : route.hops) ++count[hop.link];
  return count;
}

std::vector<std::size_t> routes_through_ends(const SiteNetwork& network, const std::vector<SiteRoute>& routes) {
  std::vector<std::size_t> count(network.ends.size());
  for (const SiteRoute& route : routes)
    for (const RouteHop& hop : route.hops)
      if (hop.from != route.site) ++count[hop.from];
  return count;
}

}  // namespace itin::viewshed
