// The tables of a siting report, as HTML. Those that are wide scroll by themselves.
#pragma once

#include <string>

#include "site/site_profiles.hpp"
#include "site/site_result.hpp"

namespace itin::cli {

/// A part of the demand, with commas where it is whole.
std::string amount(double v);

std::string sites_html(const SiteResult& result);
std::string turbines_html(const SiteResult& result);
/// How closely candidates had to be looked at.
std::string stages_html(const SiteResult& result);
/// The options that came nearest to being chosen.
std::string closest_html(const SiteResult& result);
/// Each site's route to the hub with its hops.
std::string routes_html(const SiteResult& result);
/// Every line of sight between two ends.
std::string links_html(const SiteResult& result);

}  // namespace itin::cli
