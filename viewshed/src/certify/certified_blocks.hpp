// Certified viewsheds at a level that is read as a whole.
#pragma once

#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Hides block by block what ground hides that the level is certain of (judge/block_judge.hpp), and decides exactly
/// what lies near each observer; all else is undecided. Features hide nothing but near the observer. Also returns the
/// coarse surface. Throws as compute_certified() does.
ViewshedWithSurface certify_by_blocks(const Store& store, const Request& request, Progress& progress);

/// For each tile of the cells, by how much targets may stand above the bare surface there, grid units; empty where none
/// does.
std::vector<double> rises_of_targets(const Store& store, const Request& request, const RasterGrid& grid,
                                     const RasterGrid& tiles);

}  // namespace itin::viewshed
