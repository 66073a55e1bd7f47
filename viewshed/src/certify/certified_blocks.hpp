// Certified viewsheds at a level that is read as a whole.
#pragma once

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Hides, block by block, what is hidden by ground that the level is certain of (judge/block_judge.hpp), and decides
/// exactly what lies near each observer; all else is undecided. Features hide nothing except near the observer. Also
/// returns the coarse surface. Throws what compute_certified() throws.
ViewshedWithSurface certify_by_blocks(const Store& store, const Request& request, Progress& progress);

}  // namespace itin::viewshed
