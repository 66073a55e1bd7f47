// Viewsheds of surfaces of triangles that do not fit into the memory: segment by segment about each observer.
//
// At full detail a certified pass at a coarse level decides most cells. Where the lines to the others come near the
// ground, and no more, it is read: a segment is the ground that tiles of cells next to each other in azimuth need, as
// many as fit. Where certificates do not help, it is all ground under the lines.
#pragma once

#include <cstdint>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// The answer of the surface at the request's detail, and a coarse surface. `memory` is for the surfaces alone, bytes.
/// Throws as compute_with_surface() does.
ViewshedWithSurface compute_in_tin_segments(const Store& store, const Request& request, std::uint64_t memory,
                                            Progress& progress);

}  // namespace itin::viewshed
