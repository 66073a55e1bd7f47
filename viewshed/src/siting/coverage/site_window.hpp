// The ground that sites may see.
#pragma once

#include <cstddef>
#include <vector>

#include <itin/window.hpp>
#include <viewshed/site_coverage.hpp>

namespace itin::viewshed {

/// The numbers of all sites.
std::vector<std::size_t> all_options(const SiteSurvey& survey);

/// About all sites as far as they serve.
Box reach_of(const SiteSurvey& survey);

/// The disc about a site, and about several few rectangles that hold their discs: a window of hundreds of discs takes
/// long to classify.
Window window_about(const SiteSurvey& survey, const std::vector<std::size_t>& options);

}  // namespace itin::viewshed
