// Some triangles of a larger mesh as a mesh of their own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "triangulate/growing_mesh.hpp"
#include "triangulate/region.hpp"

namespace itin {

/// The triangles `kept`, ascending, with the vertices that they use in Morton order and with those of the edges that
/// are part of a theme's line and of one of them. The first `in_order` vertices are in that order already.
RegionMesh cut_out(const PlaneMesh& mesh, std::span<const std::uint32_t> kept, std::span<const SegmentEdge> edges,
                   std::span<const SelectedVertex> vertices, std::uint32_t in_order);

}  // namespace itin
