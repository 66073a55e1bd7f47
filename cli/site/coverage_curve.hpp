// The share of the demand that the choice serves against the number of its sites.
#pragma once

#include <string>

#include <viewshed/site_plan.hpp>

namespace itin::cli {

/// Returns the curve as an SVG as wide as the page, below the bound on every choice.
std::string coverage_curve(const viewshed::SitePlan& r);

}  // namespace itin::cli
