// Triangles that need no triangulation: they follow from where the vertices stand.
#pragma once

#include <cstdint>
#include <vector>

#include "triangulate/mesh/delaunay.hpp"

namespace itin {

class KnownTriangles {
 public:
  virtual ~KnownTriangles() = default;

  /// Returns the number of triangles that fill() puts first.
  virtual std::uint32_t triangle_count() const = 0;
  /// Returns the indices of the positions that belong to triangles elsewhere or are ends of segments, ascending.
  virtual const std::vector<std::uint32_t>& rest() const = 0;
  /// Turns the triangulation of rest(), of the segments and of vertices outside the known box into that of all
  /// vertices. Vertices of the mesh have their numbers here.
  virtual void fill(PlaneMesh& mesh) const = 0;
};

}  // namespace itin
