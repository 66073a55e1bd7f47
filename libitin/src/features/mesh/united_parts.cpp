#include "features/mesh/united_parts.hpp"

#include <iterator>
#include <utility>

#include "features/mesh/footprint_arrangement.hpp"
#include "features/plan/plan_on_grid.hpp"

namespace itin {

namespace {

GridBox box_of_part(const std::vector<GridRing>& rings) {
  GridBox box;
  for (const GridRing& ring : rings)
    for (const Position& p : ring) box.extend(p.x, p.y);
  return box;
}

UnitedParts side_by_side(const std::vector<FeaturePart>& parts) {
  UnitedParts result;
  for (const FeaturePart& part : parts) result.rings.insert(result.rings.end(), part.begin(), part.end());
  return result;
}

}  // namespace

std::vector<PlanRing> rings_in_metres(const GridPolygons& polygons, const Grid& grid) {
  std::vector<PlanRing> rings;
  for (const GridPolygon& polygon : polygons) {
    for_each_ring(polygon, [&](const GridRing& ring) {
      PlanRing& out = rings.emplace_back();
      for (const Position& p : ring) out.push_back(grid.position(p.x, p.y));
    });
  }
  return rings;
}

UnitedParts united_parts(const std::vector<FeaturePart>& parts, const Grid& grid) {
  std::vector<std::vector<GridRing>> on_grid;
  std::vector<GridBox> boxes;
  for (const FeaturePart& part : parts) {
    auto rings = rings_on_grid(part, grid);
    if (!rings) return side_by_side(parts);
    boxes.push_back(box_of_part(on_grid.emplace_back(std::move(*rings))));
  }
  UnitedParts result;
  for (const std::vector<std::uint32_t>& group : groups_of(boxes)) {
    std::vector<PlanRing> rings = parts[group.front()];
    if (group.size() > 1) {
      std::vector<std::vector<GridRing>> members;
      for (const std::uint32_t i : group) members.push_back(std::move(on_grid[i]));
      const EvenOdd united = union_of(std::move(members));
      result.repaired |= united.repaired;
      rings = rings_in_metres(united.polygons, grid);
    }
    std::move(rings.begin(), rings.end(), std::back_inserter(result.rings));
  }
  return result;
}

}  // namespace itin
