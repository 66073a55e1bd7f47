#include "turbines/turbine_shadows.hpp"

#include <algorithm>
#include <iterator>

#include <itin/grid_units.hpp>
#include <itin/parallel.hpp>

namespace itin::viewshed {

namespace {

/// Returns the part of the rim that lines within the turbine's radius may cross.
std::vector<RimEdge> rim_about(const Turbine& turbine, const FullSurface& ground) {
  const Box within =
      square_about(place_in_units(ground.units(), turbine.position), turbine.radius / ground.units().resolution + 1);
  std::vector<RimEdge> rim;
  std::copy_if(ground.rim().begin(), ground.rim().end(), std::back_inserter(rim), [&](const RimEdge& edge) {
    const auto& [a, b] = edge;
    return std::max(a.x, b.x) >= within.xmin && std::min(a.x, b.x) <= within.xmax &&
           std::max(a.y, b.y) >= within.ymin && std::min(a.y, b.y) <= within.ymax;
  });
  return rim;
}

}  // namespace

TurbineShadows shadows_of_turbines(const FullSurface& ground, const Zone& zone) {
  TurbineShadows shadows(zone.request.turbines.size());
  if (!zone.crosses_voids) return shadows;
  parallel_for(shadows.size(), [&](std::size_t k) {
    const Turbine& turbine = zone.request.turbines[k];
    const std::vector<RimEdge> rim = rim_about(turbine, ground);
    if (!may_cross_voids(ground.units(), rim, turbine.position, turbine.radius)) return;
    const Point2 place = place_in_units(ground.units(), turbine.position);
    shadows[k].emplace(rim, Point3{place.x, place.y, 0});
  });
  return shadows;
}

}  // namespace itin::viewshed
