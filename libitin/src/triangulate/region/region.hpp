// The triangles of the global constrained Delaunay triangulation that meet one region, by one thread.
//
// This is the kernel under every window query and under the import's verification. It triangulates a box around the
// region, except for the full squares of a lattice (lattice_squares.hpp). Then it proves each ground triangle that
// meets the region to be global, or mends it:
//   1. a triangle whose circumdisc lies in the box, or as much of it as the triangle sees past the lines there
//      (enclosure.hpp), is global, as everything that could disturb it has been read;
//   2. otherwise no segment may cross it, and no vertex may lie in it. Beyond each of its unconstrained edges, no
//      vertex that is visible from both ends of the edge may lie in its circumcircle (apex.hpp looks that up).
//      Vertices and segments that are found are inserted, and so on.
// At the end every triangle satisfies the constrained Delaunay property against the whole store, whatever the region
// or its box (C. L. Lawson's local test made global; Lee and Lin 1986).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <itin/box_of.hpp>
#include <itin/tin.hpp>

#include "store/codec/point_index.hpp"
#include "triangulate/apex/apex.hpp"
#include "triangulate/apex/selection.hpp"
#include "triangulate/mesh/delaunay.hpp"
#include "triangulate/region/grid_window.hpp"

namespace itin {

/// The triangles of one region: only ground triangles that meet it, and only vertices that they use, in ascending
/// Morton order.
struct RegionMesh {
  std::vector<SelectedVertex> vertices;
  PlaneMesh mesh;               ///< in_order(); neighbours are kNoTriangle where there is no triangle in this mesh
  std::vector<LineEdge> lines;  ///< edges of these triangles that are part of a theme's line
  RetrievalStatistics statistics;

  /// Returns the corners, counterclockwise.
  std::array<Position, 3> corners(std::uint32_t triangle) const {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return {vertices[a].position(), vertices[b].position(), vertices[c].position()};
  }
  GridBox box_of_triangle(std::uint32_t triangle) const { return box_of(corners(triangle)); }
};

/// Returns the triangles that meet both `tile` and, if given, `window`. Touching counts.
RegionMesh triangulate_region(const PointIndex& index, const Selection& selection, const GridBox& tile,
                              const GridWindow* window = nullptr);

}  // namespace itin
