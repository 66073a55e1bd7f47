// Certified viewsheds at levels that do not fit into the memory: sector by sector about each observer.
#pragma once

#include <cstdint>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// As certify_by_blocks(), by envelopes of about so many points, or of a few cells. Bins are smaller in a sector, so
/// that it may decide more. Throws as compute_certified() does.
ViewshedWithSurface certify_by_sectors(const Store& store, const Request& request, std::uint64_t most_points,
                                       Progress& progress);

}  // namespace itin::viewshed
