// The ground that several sites may see.
#pragma once

#include <cstddef>
#include <vector>

#include <itin/window.hpp>
#include <viewshed/site_coverage.hpp>

namespace itin::viewshed {

/// Few rectangles that hold the discs about some of the sites: a window of hundreds of discs takes long to classify.
Window window_about(const std::vector<SitePosition>& positions, const std::vector<std::size_t>& options, double radius);

}  // namespace itin::viewshed
