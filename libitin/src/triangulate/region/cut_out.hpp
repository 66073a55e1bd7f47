// Makes some triangles of a larger mesh a mesh of their own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "triangulate/mesh/growing_mesh.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

/// Cuts out the triangles `kept`, ascending, with the vertices that they use, in Morton order. Keeps those of `edges`
/// that are part of a theme's line and of a kept triangle. The first `in_order` vertices are in Morton order already.
RegionMesh cut_out(const PlaneMesh& mesh, std::span<const std::uint32_t> kept, std::span<const SegmentEdge> edges,
                   std::span<const SelectedVertex> vertices, std::uint32_t in_order);

}  // namespace itin
