// Certified viewsheds at levels that do not fit into the memory: sector by sector about each observer.
#pragma once

#include <cstdint>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

#include "request/void_shadow.hpp"

namespace itin::viewshed {

/// By envelopes of about so many points, or of a few cells; and a coarse surface. Certain of what the level is certain
/// of as a whole, but for a cell here and there where sectors end: bounds are closer there, and coarse ground stays
/// beside finer one. Throws as compute_certified() does.
Surveyed certify_by_sectors(const Store& store, const Request& request, Voids voids, std::uint64_t most_points,
                            Progress& progress);

}  // namespace itin::viewshed
