// The places that ground without data hides from a turbine, or leaves undecided.
//
//   const TurbineShadows shadows = shadows_of_turbines(ground, zone);
//   if (shadows[turbine] && shadows[turbine]->holds(eye.x, eye.y)) ...
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <viewshed/turbines.hpp>

#include "request/void_shadow.hpp"
#include "scene/exact_scene.hpp"

namespace itin::viewshed {

/// A shadow for each turbine of the zone; nothing where no sight line to the turbine leaves the data and comes back.
using TurbineShadows = std::vector<std::optional<VoidShadow>>;

/// Finds the shadows of all turbines. The ground may be that of a part of the zone (turbines/zone_parts.hpp); the
/// shadows then hold for the lines of that part.
TurbineShadows shadows_of_turbines(const ExactScene& ground, const Zone& zone);

/// Returns about the memory that the shadows of turbines on cells in this box take, over ground with this rim; 0 where
/// there are none.
std::uint64_t bytes_of_shadows(const std::vector<Turbine>& turbines, const Box& cells, const Grid& units,
                               const std::vector<RimEdge>& rim);

}  // namespace itin::viewshed
