// Precise viewsheds of rasters whose posts do not fit into the memory: sector by sector about each observer.
//
// Only the posts of a sector (sight_sectors.hpp) that the observer may see (reveal.hpp) are read. Their number is
// guessed from the sectors before; what turns out not to fit comes again in narrower sectors, down to a single cell.
#pragma once

#include <cstdint>
#include <optional>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Returns the full surface's answer, with a coarse surface; nothing where the surface is no lattice. `memory` is for
/// the surface alone, bytes. Precondition: takes_a_lattice(). Throws what compute_with_surface() throws, and InputError
/// where the line to a single cell does not fit.
std::optional<ViewshedWithSurface> compute_by_lattice_sectors(const Store& store, const Request& request,
                                                              std::uint64_t memory, const CellSink& sink,
                                                              Progress& progress);

}  // namespace itin::viewshed
