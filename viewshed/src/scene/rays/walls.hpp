// Walls under the edge of a surface, so that no ray passes from outside to beneath it unnoticed.
#pragma once

#include <cstdint>
#include <vector>

#include <itin/tin.hpp>

#include "bounds/boundary.hpp"
#include "scene/rays/tessellation.hpp"

namespace itin::viewshed {

/// Two triangles per edge, side by side in order, seen counterclockwise from outside the surface.
struct Walls {
  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;
};

/// From below everything up to the surface's edge.
Walls walls_under(const Tin& tin, const std::vector<BoundaryEdge>& boundary, const Tessellation& tessellation,
                  double drop);

}  // namespace itin::viewshed
