// Goes through the tiles of a grid, and within a tile from one site to the next.
//
//   const EnvelopeJudge judge(scene, grid, tiles, eyes_of(units, survey, sites));
//   std::vector<CoverageBounds> after = judge_tiles(judge, zone, survey, sites, progress, statistics);
#pragma once

#include <optional>
#include <vector>

#include "judge/clear_zone.hpp"
#include "judge/tile_judge.hpp"
#include "siting/coverage/group_survey.hpp"

namespace itin::viewshed {

/// Judges the sites on all threads. The judge has the eyes of the sites, in their order; where a zone is given, targets
/// in sight count only if they leave it clear. The bounds returned are not yet marked as exact.
std::vector<CoverageBounds> judge_tiles(const TileJudge& judge, const std::optional<ClearZone>& zone,
                                        const SiteSurvey& survey, const SitesToJudge& sites, Progress& progress,
                                        Statistics& statistics);

}  // namespace itin::viewshed
