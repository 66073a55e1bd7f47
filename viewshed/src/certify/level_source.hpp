// Certified viewsheds over a coarse level: read as a whole or, where it does not fit into the memory, sector by sector
// about each observer.
//
// What is hidden by ground that the level is certain of is hidden block by block (judge/block_judge.hpp), and what lies
// near each observer is decided exactly; all else is undecided. Features hide nothing except near the observer.
#pragma once

#include <cstdint>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Certifies over the whole level. Also returns the coarse surface. Throws what compute_certified() throws.
ViewshedWithSurface certify_by_blocks(const Store& store, const Request& request, const CellSink& sink,
                                      Progress& progress);

/// Certifies by envelopes of about `most_points` points, or of a few cells. Bins are smaller in a sector, so that it
/// may decide more.
ViewshedWithSurface certify_by_sectors(const Store& store, const Request& request, std::uint64_t most_points,
                                       const CellSink& sink, Progress& progress);

}  // namespace itin::viewshed
