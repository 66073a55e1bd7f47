// A feature that stands on the ground, as sources give it: its footprint in plan and how high it reaches.
//
// Units: metres, in the CRS of the store. Rings are open or closed, of any orientation, and are read by the even-odd
// rule: a ring inside another is a courtyard, one inside that is solid again.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/theme.hpp>

namespace itin {

enum class FeatureKind { building, vegetation, wall, terrace };

using PlanRing = std::vector<Point2>;

/// A plane piece of a roof with its elevations; the first ring is its outline, all others are holes.
struct RoofSurface {
  std::vector<std::vector<Point3>> rings;
};

struct FootprintFeature {
  std::string name;  ///< the name of the feature in messages
  FeatureKind kind = FeatureKind::building;
  std::vector<PlanRing> rings;
  BaseRule base_rule = BaseRule::minimum;
  std::optional<double> base;    ///< elevation; default: from the terrain. Only buildings have one: all else drapes
  std::optional<double> height;  ///< of the highest point above the base (above the terrain, where it drapes)
  std::optional<double> eaves;   ///< of the eaves above the base; default: from height and pitch
  RoofKind roof = RoofKind::flat;
  std::vector<RoofSurface> surfaces;  ///< a measured roof; takes the place of height, eaves and roof
};

inline std::uint64_t vertex_count(const FootprintFeature& feature) {
  std::uint64_t count = 0;
  for (const PlanRing& ring : feature.rings) count += ring.size();
  for (const RoofSurface& surface : feature.surfaces)
    for (const auto& ring : surface.rings) count += ring.size();
  return count;
}

}  // namespace itin
