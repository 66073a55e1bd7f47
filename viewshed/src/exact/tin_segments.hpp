// Viewsheds of surfaces of triangles that do not fit into the memory, or that are mostly hidden: segment by segment
// about each observer.
//
// At full detail a certified pass at a coarse level decides most cells. Only the ground that the lines to the other
// cells come near is read: a segment is the ground that tiles of cells next to each other in azimuth need, as many
// tiles as fit. At a tolerance the pass tells what is hidden, and only the rest of the ground under the lines is read.
// Where certificates do not help, all ground under the lines is read.
#pragma once

#include <cstdint>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Tells whether no more ground is read than may be seen. That is so at a tolerance, where nothing stands on the ground
/// and the request's mode asks no more than what is seen.
bool reads_what_may_be_seen(const Store& store, const Request& request);

/// Returns the answer of the surface at the request's detail, with a coarse surface. `memory` is for the surfaces
/// alone, bytes. Throws what compute_with_surface() throws.
ViewshedWithSurface compute_in_tin_segments(const Store& store, const Request& request, std::uint64_t memory,
                                            const CellSink& sink, Progress& progress);

}  // namespace itin::viewshed
