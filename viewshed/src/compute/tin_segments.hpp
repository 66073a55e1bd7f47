// Viewsheds of surfaces of triangles that do not fit into the memory, or of which little is seen: segment by segment
// about each observer.
//
// At full detail a certified pass at a coarse level decides most cells. Where the lines to the others come near the
// ground, and no more, it is read: a segment is the ground that tiles of cells next to each other in azimuth need, as
// many as fit. At a tolerance the pass tells what is hidden, and the ground under the lines is read that is not. Where
// certificates do not help, it is all ground under the lines.
#pragma once

#include <cstdint>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Whether no more ground is read than may be seen: at a tolerance, where nothing stands on it and the request's mode
/// asks no more than what is seen.
bool reads_what_may_be_seen(const Store& store, const Request& request);

/// The answer of the surface at the request's detail, and a coarse surface. `memory` is for the surfaces alone, bytes.
/// Throws as compute_with_surface() does.
ViewshedWithSurface compute_in_tin_segments(const Store& store, const Request& request, std::uint64_t memory,
                                            Progress& progress);

}  // namespace itin::viewshed
