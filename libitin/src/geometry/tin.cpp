#include <itin/box_of.hpp>
#include <itin/tin.hpp>

#include "geometry/cell.hpp"

namespace itin {

VertexId Tin::id(std::uint32_t vertex) const {
  return morton(vertices[vertex].x, vertices[vertex].y);
}

std::uint16_t Tin::theme(const Triangle& t) const {
  if (raised_theme.empty()) return 0;
  // Outlines are lines, so all corners off them lie within one and the same feature or its neighbours' walls.
  for (const std::uint32_t v : t)
    if (raised_theme[v] != 0) return raised_theme[v];
  return 0;
}

Box Tin::bounds() const {
  return grid.box(box_of(vertices));
}

}  // namespace itin
