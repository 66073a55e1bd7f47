// Observes the cells of a surface, tile by tile.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <itin/progress.hpp>
#include <viewshed/result.hpp>

#include "judge/exact_judge.hpp"
#include "line/tile_parts.hpp"
#include "modes/observation.hpp"
#include "progress/stage.hpp"

namespace itin::viewshed {

/// Observes every cell from every eye, and fills the result's rasters and counts. The result's request says in what
/// mode, its grid is the surface's, and `crosses_voids` tells whether ground without data matters. `studies` are the
/// surface's, where the mode needs any. `views` are the eyes', or none: then they are made when they are needed, for
/// some hundreds of eyes at a time. Memory: 36 kB per thread; what a mode keeps of all cells, where there are hundreds
/// of eyes; and the edges of voids that each eye sees from behind, where ground without data matters. Throws Cancelled.
void observe_all(const FullSurface& surface, const TriangleStudies* studies, const std::vector<Eye>& eyes,
                 std::vector<RadialSweep::View> views, Result& result, Progress& progress);

/// Observes some cells from the judge's only eye, which is this observer's; `observations` has one for each tile. Every
/// cell is a step of the stage. Returns how many sight lines that took. Throws Cancelled.
std::uint64_t observe(const ExactJudge& judge, std::uint32_t observer, std::span<const PartsOfTile> cells,
                      const std::vector<std::unique_ptr<Observation>>& observations, const TriangleStudies* studies,
                      Stage& stage);

}  // namespace itin::viewshed
