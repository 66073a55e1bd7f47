// The facades of a building: straight runs of its walls that stand on open ground.
//
//   for (const DwellingFacade& facade : facades_of(wall_places(building, progress))) ...
#pragma once

#include <vector>

#include <viewshed/dwellings.hpp>
#include <viewshed/premises.hpp>

namespace itin::viewshed {

/// Joins the stretches of walls, which come ring by ring in their order. A wall above a lower roof is part of no
/// facade. The eye of a facade is that of its middle stretch.
std::vector<DwellingFacade> facades_of(const std::vector<WallPlace>& walls);

}  // namespace itin::viewshed
