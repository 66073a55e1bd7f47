// The tables of a siting report, as HTML. Wide tables scroll by themselves.
#pragma once

#include <string>

#include <viewshed/site_plan.hpp>

namespace itin::cli {

std::string sites_html(const viewshed::SitePlan& r);
std::string turbines_html(const viewshed::SitePlan& r);
/// Returns a table of the first points of the demand that are not served, and says how many there are.
std::string points_html(const viewshed::SitePlan& r);
/// Returns a table of how closely candidates had to be surveyed.
std::string stages_html(const viewshed::SitePlan& r);
/// Returns a table of the options that came nearest to being chosen.
std::string closest_html(const viewshed::SitePlan& r);
/// Returns a table of each site's route to the hub with its hops.
std::string routes_html(const viewshed::SitePlan& r);
/// Returns a table of every line of sight between two ends.
std::string links_html(const viewshed::SitePlan& r);

}  // namespace itin::cli
