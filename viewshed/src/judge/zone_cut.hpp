// Tells, among the cells of a tile that are in sight, which have clear Fresnel zones.
#pragma once

#include <cstdint>

#include "judge/clear_zone.hpp"
#include "judge/tile_judge.hpp"
#include "line/cell_tiles.hpp"
#include "request/eye.hpp"

namespace itin::viewshed {

/// Turns visible and undecided cells whose zone is certainly cut to Verdict::kZoneCut, and visible cells whose zone is
/// not certainly clear to Verdict::kUndecided. A target at the eye's own place has no zone. Throws Cancelled.
void cut_zones(const ClearZone& zone, const Eye& eye, const TileTargets& targets, const Progress& progress,
               TileValues<Verdict>& values);

}  // namespace itin::viewshed
