// Precise viewsheds of rasters whose posts do not fit into the memory: sector by sector about each observer.
//
// A segment is the hull of the observer and some tiles of cells, next to each other in azimuth, so that it holds all
// their sight lines. Of its posts only those are read that the observer may see (reveal.hpp). What of them that will be
// cannot be told before: a segment that turns out to be too large is halved and begun anew.
#pragma once

#include <cstdint>
#include <optional>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// The full surface's answer, and a coarse surface. Nothing where the surface is no lattice, or the mode asks for more
/// than sight lines. `memory` is for the surface alone, bytes. Throws as compute_precise() does, and InputError where
/// the lines to a single tile of cells do not fit.
std::optional<Surveyed> compute_in_lattice_segments(const Store& store, const Request& request, std::uint64_t memory,
                                                    Progress& progress);

}  // namespace itin::viewshed
