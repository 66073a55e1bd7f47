#include "features/mesh/foundation_reaches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "features/plan/mask_index.hpp"
#include "geometry/cell.hpp"

namespace itin {

namespace {

/// How far, in grid steps, feet that were rounded, or joined with other lines, may reach into the triangles beside
/// theirs.
constexpr std::int32_t kFootReach = 3;
/// A margin of height against rounding, in grid steps.
constexpr std::int32_t kHeightMargin = 2;

}  // namespace

std::optional<std::int32_t> FoundationReaches::height_of_vertex(Position p) const {
  const auto at = find_by_code(mesh_.vertices, code_of(p));
  return at == mesh_.vertices.end() ? std::nullopt : std::optional(at->z);
}

FeatureReach FoundationReaches::of(std::size_t mask) const {
  const GridPolygon& polygon = mesh_.masks[mask].polygon;
  FeatureReach reach{box_about(polygon), 0, 0};
  if (!any_) return reach;
  const double resolution = terrain_.grid().resolution;
  double lowest = std::numeric_limits<double>::infinity(), highest_above = 0, deepest = 0;
  for_each_ring(polygon, [&](const GridRing& ring) {
    for (const Position& p : ring) {
      const auto z = height_of_vertex(p);
      const auto ground = terrain_.height_at(p);
      if (!z || !ground) continue;
      lowest = std::min(lowest, 1.0 * *z);
      highest_above = std::max(highest_above, *z - *ground / resolution);
      deepest = std::max(deepest, *ground / resolution - *z);
    }
  });
  // A neighbour's foundation may have lowered a corner that both share.
  if (!founded(features_[mesh_.masks[mask].feature]) && deepest <= kHeightMargin) return reach;
  for_each_edge(polygon, [&](Position a, Position b) {
    for (const std::uint32_t t : terrain_.triangles_along(a, b, kFootReach)) {
      const GridBox box = terrain_.box_of_triangle(t);
      reach.box.extend(box);
    }
  });
  reach.box = expanded(reach.box, 1);
  const auto high = terrain_.base_height({polygon}, BaseRule::maximum);
  const double within = high ? *high / resolution - lowest : 0;
  reach.depth = std::max(0, static_cast<std::int32_t>(std::ceil(std::max(deepest, within)))) + kHeightMargin;
  reach.height = std::max(0, static_cast<std::int32_t>(std::ceil(highest_above))) + kHeightMargin;
  return reach;
}

}  // namespace itin
