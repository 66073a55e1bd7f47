// What ground without data hides from a turbine, or leaves undecided.
//
//   const TurbineShadows shadows = shadows_of_turbines(ground, zone);
//   if (shadows[turbine] && shadows[turbine]->holds(eye.x, eye.y)) ...
#pragma once

#include <optional>
#include <vector>

#include <viewshed/turbines.hpp>

#include "request/void_shadow.hpp"
#include "scene/full_surface.hpp"

namespace itin::viewshed {

/// One for each turbine of the zone: nothing where no sight line to it crosses ground without data and comes back.
using TurbineShadows = std::vector<std::optional<VoidShadow>>;

/// The ground may be that of a part of the zone (turbines/zone_parts.hpp): it then tells of the lines of that part.
TurbineShadows shadows_of_turbines(const FullSurface& ground, const Zone& zone);

}  // namespace itin::viewshed
