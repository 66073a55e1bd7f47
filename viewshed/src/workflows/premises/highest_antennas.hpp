// The highest antennas that buildings may have, as targets of masts: to raise an antenna never hides it, so that a
// building is served where one of these is.
//
//   const auto antennas = highest_antennas(store, request, feet, progress);   // antennas[i] of feet[i]
#pragma once

#include <vector>

#include <itin/building_outlines.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/premises.hpp>

namespace itin::viewshed {

struct HighestAntenna {
  Point2 position;
  double height_m = 0;  ///< above the bare ground
};

/// Returns the antennas of each building, one for each of its places; none where it has no place. The ground about as
/// many buildings is read at once as the memory holds. Throws as survey_premises() does.
std::vector<std::vector<HighestAntenna>> highest_antennas(const Store& store, const PremisesRequest& request,
                                                          const std::vector<BuildingFoot>& feet, Progress& progress);

}  // namespace itin::viewshed
