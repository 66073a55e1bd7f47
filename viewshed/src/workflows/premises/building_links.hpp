// What masts are to one building: its places, and for each mast the best of them.
//
//   SurveyedBuilding found;
//   survey_building({foot, rules, masts}, surroundings, progress, found);        // perhaps for other masts again
//   choose_best(found.premises);
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <itin/building_outlines.hpp>
#include <itin/progress.hpp>
#include <viewshed/premises.hpp>

#include "places/place_scene.hpp"

namespace itin::viewshed {

/// A mast, and its view over the surface that is in memory.
struct MastView {
  const SitePosition* mast = nullptr;
  PlaceScene::View view;
};

/// What is in memory for buildings near each other. Places of the buildings, lines and all are over `scene` and the
/// bare `ground`.
struct BuildingSurroundings {
  const PremisesRequest& request;
  const PlaceScene& scene;
  const PlacedSurface& ground;
  std::span<const MastView> views;  ///< by the numbers of masts; only those of masts that are asked for are set
};

struct BuildingToSurvey {
  const BuildingFoot& foot;
  MountRules rules;
  std::span<const std::size_t> masts;  ///< their numbers, ascending
};

/// A building and what was found of it. Blockers have no names yet, and lie a little behind their positions.
struct SurveyedBuilding {
  Premises premises;                                   ///< its theme is 0 until it is surveyed
  std::vector<std::optional<Point2>> within_blockers;  ///< one for each link
  std::uint64_t lines = 0;                             ///< sight lines decided
};

/// Surveys a building for the masts, and adds what they are to it to what was found with the masts before them. Throws
/// Cancelled.
void survey_building(const BuildingToSurvey& building, const BuildingSurroundings& surroundings,
                     const Progress& progress, SurveyedBuilding& found);

/// Chooses the best link of a building once all masts are known, and says which walls stay undecided.
void choose_best(Premises& premises);

}  // namespace itin::viewshed
