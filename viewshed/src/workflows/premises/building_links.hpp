// What masts are to one building: its places, and for each mast the best of them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <itin/building_outlines.hpp>
#include <viewshed/premises.hpp>

#include "places/place_scene.hpp"

namespace itin::viewshed {

/// A mast, and its view over the surface that is in memory.
struct MastView {
  std::size_t number = 0;
  const SitePosition* mast = nullptr;
  PlaceScene::View view;
};

/// A building and what was found of it. Blockers have no names yet, and lie a little behind their positions.
struct SurveyedBuilding {
  Premises premises;
  std::vector<std::optional<Point2>> within_blockers;  ///< one for each link
  std::uint64_t lines = 0;                             ///< sight lines decided
};

/// Surveys a building for the masts, in their order. Places of the building, lines and all are over `scene` and the
/// bare `ground`.
SurveyedBuilding survey_building(const BuildingFoot& foot, const PremisesRequest& request, const MountRules& rules,
                                 const PlaceScene& scene, const PlacedSurface& ground, std::span<const MastView> masts);

}  // namespace itin::viewshed
