#include "turbines/turbine_shadows.hpp"

#include <algorithm>
#include <iterator>

#include <itin/grid_units.hpp>
#include <itin/parallel.hpp>

namespace itin::viewshed {

namespace {

/// Returns the part of the rim that lines from the cells within the turbine's radius may cross. Empty where no line
/// comes back to the ground.
std::vector<RimEdge> rim_about(const Turbine& turbine, const Box& cells, const Grid& units,
                               const std::vector<RimEdge>& rim) {
  const Box within = square_about(place_in_units(units, turbine.position), turbine.radius / units.resolution + 1);
  std::vector<RimEdge> about;
  std::copy_if(rim.begin(), rim.end(), std::back_inserter(about), [&](const RimEdge& edge) {
    const auto& [a, b] = edge;
    return std::max(a.x, b.x) >= within.xmin && std::min(a.x, b.x) <= within.xmax &&
           std::max(a.y, b.y) >= within.ymin && std::min(a.y, b.y) <= within.ymax;
  });
  if (!may_cross_voids(units, about, turbine.position, turbine.radius, cells)) about.clear();
  return about;
}

}  // namespace

TurbineShadows shadows_of_turbines(const ExactScene& ground, const Zone& zone) {
  TurbineShadows shadows(zone.request.turbines.size());
  if (!zone.crosses_voids) return shadows;
  parallel_for(shadows.size(), [&](std::size_t k) {
    const Turbine& turbine = zone.request.turbines[k];
    const std::vector<RimEdge> rim = rim_about(turbine, zone.grid.bounds(), ground.units(), ground.rim());
    if (rim.empty()) return;
    const Point2 place = place_in_units(ground.units(), turbine.position);
    shadows[k].emplace(rim, Point3{place.x, place.y, 0});
  });
  return shadows;
}

std::uint64_t bytes_of_shadows(const std::vector<Turbine>& turbines, const Box& cells, const Grid& units,
                               const std::vector<RimEdge>& rim) {
  std::uint64_t bytes = 0;
  for (const Turbine& turbine : turbines)
    if (const std::vector<RimEdge> about = rim_about(turbine, cells, units, rim); !about.empty())
      bytes += bytes_of_shadow(about.size());
  return bytes;
}

}  // namespace itin::viewshed
