// Certified viewsheds at levels that do not fit into the memory: sector by sector about each observer.
#pragma once

#include <cstdint>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Certifies as certify_by_blocks() does, by envelopes of about `most_points` points, or of a few cells. Bins are
/// smaller in a sector, so that it may decide more. Throws what compute_certified() throws.
ViewshedWithSurface certify_by_sectors(const Store& store, const Request& request, std::uint64_t most_points,
                                       Progress& progress);

}  // namespace itin::viewshed
