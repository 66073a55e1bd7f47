#include <itin/tin.hpp>

#include "store/cell.hpp"

namespace itin {

VertexId Tin::id(std::uint32_t vertex) const {
  return morton(vertices[vertex].x, vertices[vertex].y);
}

Box Tin::bounds() const {
  GridBox box;
  for (const GridPoint& v : vertices) box.extend(v.x, v.y);
  return grid.box(box);
}

}  // namespace itin
