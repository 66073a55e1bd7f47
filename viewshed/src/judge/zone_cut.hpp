// Leaves of the cells of a tile that are in sight those whose Fresnel zones are clear.
#pragma once

#include <cstdint>

#include "judge/clear_zone.hpp"
#include "judge/tile_judge.hpp"
#include "line/cell_tiles.hpp"
#include "request/eye.hpp"

namespace itin::viewshed {

/// Visible cells and undecided ones whose zone is certainly cut become Verdict::kZoneCut; visible ones become
/// Verdict::kUndecided where it is not certainly clear. A target at the eye's own place has no zone.
void cut_zones(const ClearZone& zone, const Eye& eye, const TileTargets& targets, TileValues<Verdict>& values);

}  // namespace itin::viewshed
