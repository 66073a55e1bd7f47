// The ground that sites may see.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <itin/window.hpp>
#include <viewshed/site_coverage.hpp>

namespace itin::viewshed {

/// Returns the numbers of all sites.
std::vector<std::size_t> all_options(const SiteSurvey& survey);

/// Return the box that holds the radius about all sites, or about these.
Box reach_of(const SiteSurvey& survey);
Box reach_of(const SiteSurvey& survey, std::span<const std::size_t> options);

/// Returns the disc about a single site; for several sites, a few rectangles that hold their discs, since a window of
/// hundreds of discs takes long to classify.
Window window_about(const SiteSurvey& survey, const std::vector<std::size_t>& options);

}  // namespace itin::viewshed
