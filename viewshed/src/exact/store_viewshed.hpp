// Viewsheds over what is retrieved of a store at once: the first two ways that compute_with_surface() tries.
#pragma once

#include <cstdint>
#include <optional>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Computes over a lattice; nothing where the surface is no lattice of at most `most_posts` posts. Precondition:
/// takes_a_lattice().
std::optional<ViewshedWithSurface> compute_over_lattice(const Store& store, const Request& request,
                                                        std::uint64_t most_posts, const CellSink& sink,
                                                        Progress& progress);

/// Computes over triangles: takes every surface, mode and detail.
ViewshedWithSurface compute_over_tin(const Store& store, const Request& request, const CellSink& sink,
                                     Progress& progress);

}  // namespace itin::viewshed
