// The ground that sites may see.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <itin/window.hpp>
#include <viewshed/site_coverage.hpp>

namespace itin::viewshed {

/// The numbers of all sites.
std::vector<std::size_t> all_options(const SiteSurvey& survey);

/// About all sites, or these, as far as they serve.
Box reach_of(const SiteSurvey& survey);
Box reach_of(const SiteSurvey& survey, std::span<const std::size_t> options);

/// The disc about a site, and about several few rectangles that hold their discs: a window of hundreds of discs takes
/// long to classify.
Window window_about(const SiteSurvey& survey, const std::vector<std::size_t>& options);

}  // namespace itin::viewshed
