// Where sites lie, and the ground that they may see.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
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

/// Sorts the sites by place, and returns the half in the west and that in the east, or those in the south and in the
/// north.
std::pair<std::span<std::size_t>, std::span<std::size_t>> halves_across(const std::vector<SitePosition>& positions,
                                                                        std::span<std::size_t> sites);

}  // namespace itin::viewshed
