// The parts of one feature as one footprint. Sources give a house as several polygons that overlap, lie within each
// other or come twice; what any of them covers belongs to the house.
#pragma once

#include <vector>

#include <itin/geometry.hpp>

#include "features/plan/plan_overlay.hpp"
#include "store/segments/footprint.hpp"

namespace itin {

/// A polygon of a feature: its outline and its holes, by the even-odd rule.
using FeaturePart = std::vector<PlanRing>;

struct UnitedParts {
  std::vector<PlanRing> rings;  ///< disjoint, for the even-odd rule; none where no part has an area
  bool repaired = false;        ///< the rings of a part crossed or touched themselves or each other
};

/// Returns the union of parts. Those near no other part keep their rings as they are; others get corners on the grid. A
/// feature that leaves the grid stays as it is, for it stands nowhere. Throws OverlayError where parts cross too often.
UnitedParts united_parts(const std::vector<FeaturePart>& parts, const Grid& grid);

/// The rings of polygons, in metres.
std::vector<PlanRing> rings_in_metres(const GridPolygons& polygons, const Grid& grid);

}  // namespace itin
