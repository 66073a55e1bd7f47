// What the rings of footprints and of roof surfaces cover in plan, on the grid.
//
//   if (const auto plan = plan_on_grid(feature.rings, grid)) draw(plan->polygons);
#pragma once

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "features/plan/plan_overlay.hpp"
#include "store/segments/footprint.hpp"

namespace itin {

/// Returns rings of Point2 or Point3 as positions; nothing where one has coordinates beyond the grid.
template <class Rings>
std::optional<std::vector<GridRing>> rings_on_grid(const Rings& rings, const Grid& grid) {
  std::vector<GridRing> on_grid;
  for (const auto& ring : rings) {
    GridRing& positions = on_grid.emplace_back();
    for (const auto& p : ring) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !grid.covers({p.x, p.y})) return std::nullopt;
      const GridPoint q = grid.quantise({p.x, p.y, 0});
      positions.push_back({q.x, q.y});
    }
  }
  return on_grid;
}

/// Returns the plan of rings of Point2 or Point3, by the even-odd rule; nothing where one has coordinates beyond the
/// grid. Throws OverlayError.
template <class Rings>
std::optional<EvenOdd> plan_on_grid(const Rings& rings, const Grid& grid) {
  const auto on_grid = rings_on_grid(rings, grid);
  return on_grid ? std::optional(even_odd(*on_grid)) : std::nullopt;
}

/// Returns the plan that these surfaces cover together, without surfaces beyond the grid. Throws OverlayError.
inline GridPolygons plan_of(const std::vector<RoofSurface>& surfaces, const Grid& grid) {
  GridPolygons all;
  for (const RoofSurface& surface : surfaces)
    if (const auto plan = plan_on_grid(surface.rings, grid))
      all.insert(all.end(), plan->polygons.begin(), plan->polygons.end());
  return merged(all);
}

}  // namespace itin
