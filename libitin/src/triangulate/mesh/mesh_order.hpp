// One order for the triangles of a mesh, however it was made.
#pragma once

#include <cstddef>

#include "triangulate/mesh/delaunay.hpp"

namespace itin {

/// Returns the mesh with its triangles in ascending order of their vertices, each turned so that its least one comes
/// first. Results then depend on the triangulation, and not on how it was made. Vertices are less than `vertex_count`.
/// Linear time.
PlaneMesh in_order(const PlaneMesh& mesh, std::size_t vertex_count);

}  // namespace itin
