// The cell at which to enter a quadtree for the contents of a box.
#pragma once

#include <algorithm>

#include <itin/precondition.hpp>

#include "geometry/cell.hpp"

namespace itin {

/// Returns the least cell with all positions of the box that lie in the root. Precondition: the box is not empty.
inline Cell cell_about(const GridBox& box) {
  ITIN_PRECONDITION(!box.empty());
  const auto inside = [](std::int32_t v) { return std::clamp(v, -kGridHalfSide, kGridHalfSide - 1); };
  const std::uint64_t last = morton(inside(box.xmax), inside(box.ymax));
  Cell cell{morton(inside(box.xmin), inside(box.ymin)), 0};
  while (!cell.contains(last)) cell = cell.parent();
  return cell;
}

}  // namespace itin
