// Goes through the tiles of a grid, and within a tile from one site to the next.
//
//   const ExactJudge judge(surface, eyes_of(surface.units(), survey, looks), survey.nodata);
//   std::vector<CoverageBounds> after = judge_tiles(judge, zone, survey, looks, progress, statistics);
#pragma once

#include <optional>
#include <vector>

#include "judge/tile_judge.hpp"
#include "siting/coverage/clear_zone.hpp"
#include "siting/coverage/group_survey.hpp"

namespace itin::viewshed {

/// The judge's eyes are those of the looks, in their order; where a zone is given, what is seen must leave it clear. On
/// all threads. The bounds are not yet said to be exact.
std::vector<CoverageBounds> judge_tiles(const TileJudge& judge, const std::optional<ClearZone>& zone,
                                        const SiteSurvey& survey, const SiteLooks& looks, Progress& progress,
                                        Statistics& statistics);

}  // namespace itin::viewshed
