// Where a stored footprint lies in plan.
#pragma once

#include <itin/geometry.hpp>

#include "store/segments/footprint.hpp"

namespace itin {

/// How far, in metres, a place may be outside of a footprint that it belongs to.
inline constexpr double kBesideFootprint = 1;

/// Returns the box about a feature's footprint and roof.
inline Box extent_of(const FootprintFeature& feature) {
  Box box;
  for (const PlanRing& ring : feature.rings)
    for (const Point2& p : ring) box.extend(p);
  for (const RoofSurface& surface : feature.surfaces)
    for (const auto& ring : surface.rings)
      for (const Point3& p : ring) box.extend(Point2{p.x, p.y});
  return box;
}

}  // namespace itin
