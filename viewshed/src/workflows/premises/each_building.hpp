// Buildings one by one on their ground, as many in memory at once as it holds.
//
//   for_each_building(store, request, feet, {"facades", statistics}, progress,
//                     [&](std::size_t i, const StandingBuilding& building) { ... });      // building i of feet
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

#include <itin/building_outlines.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/premises.hpp>

#include "places/mount_places.hpp"

namespace itin::viewshed {

/// What the work at the buildings is called, and what counts the ground that is read for it.
struct BuildingStage {
  std::string_view name;
  Statistics& statistics;
};

/// Calls visit(its number, the building on its ground) for each of the buildings, in any order and from all threads.
/// The request tells the themes, the rules for places and the memory. Throws as survey_premises() does.
void for_each_building(const Store& store, const PremisesRequest& request, const std::vector<BuildingFoot>& feet,
                       const BuildingStage& stage, Progress& progress,
                       const std::function<void(std::size_t, const StandingBuilding&)>& visit);

}  // namespace itin::viewshed
