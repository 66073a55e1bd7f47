// Elements of a demand that have several points, as the points of a survey serve them.
#pragma once

#include <cstdint>
#include <vector>

#include <viewshed/siting.hpp>

namespace itin::viewshed {

/// Returns the elements that have a point in the set. `elements` are those of each point, ascending.
inline DemandSet elements_of_points(const std::vector<std::uint32_t>& elements, const DemandSet& points) {
  DemandSet set;
  DemandSet::Block block;
  for_each_element(points, [&](std::size_t point) {
    const std::uint32_t element = elements[point];
    if (element / 64 != block.number) {
      set.add(block.number, block.members);
      block = {element / 64, 0};
    }
    block.members |= std::uint64_t{1} << element % 64;
  });
  set.add(block.number, block.members);
  return set;
}

/// Bounds on points as bounds on elements: one is certainly served where one of its points is.
inline CoverageBounds elements_of_points(const std::vector<std::uint32_t>& elements, const CoverageBounds& points) {
  return {elements_of_points(elements, points.certain), elements_of_points(elements, points.possible), points.exact};
}

}  // namespace itin::viewshed
