// By which rules links among sites are judged, and what routes over them are like.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <profile/links.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

/// How lines between sites are judged.
struct LinkRules {
  profile::LinkQuery query;
  double fraction = 0;  ///< how much of the first Fresnel zone must be clear, 0 to 1, where there is a frequency

  /// Tells whether a line is known to be in sight, with `fraction` of the Fresnel zone clear.
  bool met_by(const profile::LineFindings& found) const {
    return found.verdict == profile::SightVerdict::kVisible && (!found.fresnel || found.fresnel->fraction >= fraction);
  }
};
LinkRules link_rules(const SitePlanRequest& request);

/// Returns the link between antennas or eyes at two sites.
profile::Link link_between(const SitePosition& from, const SitePosition& to);

/// Returns a link's outcome: "clear" as served is meant, "hidden", "undecided", or in sight only.
const char* outcome_of(const SitePlanRequest& request, const SiteLink& link);

double length_m(const SiteNetwork& network, const SiteRoute& route);
/// Returns "a → b → hub", or that there is no route.
std::string in_words(const SiteNetwork& network, const SiteRoute& route);
/// Returns the hop that leaves the least fraction of the first Fresnel zone clear; without a frequency, the hop of the
/// least clearance.
std::optional<RouteHop> worst_hop(const SiteNetwork& network, const SiteRoute& route);
/// Return how many routes go over each link, and through each end on the way from another site.
std::vector<std::size_t> routes_over_links(const SiteNetwork& network, const std::vector<SiteRoute>& routes);
std::vector<std::size_t> routes_through_ends(const SiteNetwork& network, const std::vector<SiteRoute>& routes);

}  // namespace itin::viewshed
