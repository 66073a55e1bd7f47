// Walks straight from one vertex of a mesh to another, and finds the edges that the way crosses.
#pragma once

#include <vector>

#include <itin/error.hpp>

#include "triangulate/region/region.hpp"

namespace itin {

class VertexWalk {
 public:
  /// The mesh must cover every segment that is walked.
  explicit VertexWalk(const RegionMesh& region)
      : mesh_(region.mesh), some_triangle_(region.vertices.size(), kNoTriangle) {
    positions_.reserve(region.vertices.size());
    for (const SelectedVertex& v : region.vertices) positions_.push_back(v.position());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh_.triangles[t]) some_triangle_[v] = t;
    }
  }

  /// Calls on_edge(p, q, triangle before, triangle behind) for every edge pq that the open segment uv crosses properly.
  /// Vertices on the way are passed through without a call.
  template <class OnEdge>
  void walk(std::uint32_t u, std::uint32_t v, const OnEdge& on_edge) const {
    while (u != v) u = next_vertex(u, v, on_edge);
  }

 private:
  /// Walks from vertex u towards v up to the first vertex on the segment.
  template <class OnEdge>
  std::uint32_t next_vertex(std::uint32_t u, std::uint32_t v, const OnEdge& on_edge) const {
    const Position from = positions_[u], to = positions_[v];
    const Start start = leave(u, from, to);
    if (start.vertex != kNoTriangle) return start.vertex;
    std::uint32_t t = start.triangle;
    int edge = start.edge;
    while (true) {
      const std::uint32_t right = mesh_.triangles[t][(edge + 1) % 3], left = mesh_.triangles[t][(edge + 2) % 3];
      const std::uint32_t n = mesh_.neighbours[t][edge];
      on_edge(right, left, t, n);
      if (n == kNoTriangle) throw Error("a walk left the mesh");
      const auto& corners = mesh_.triangles[n];
      const int i = corners[0] != right && corners[0] != left ? 0 : corners[1] != right && corners[1] != left ? 1 : 2;
      const int side = orientation(from, to, positions_[corners[i]]);
      if (side == 0) return corners[i];
      // Corner i lies left or right of the way; the edge on its other side is crossed next.
      edge = side > 0 ? (corners[(i + 1) % 3] == right ? (i + 2) % 3 : (i + 1) % 3)
                      : (corners[(i + 1) % 3] == left ? (i + 2) % 3 : (i + 1) % 3);
      t = n;
    }
  }

  struct Start {
    std::uint32_t vertex;  ///< the way goes along an edge to this vertex, if not kNoTriangle
    std::uint32_t triangle;
    int edge;
  };

  /// Turns about u counterclockwise, and then clockwise from the start if a border stopped that. The edge between a
  /// triangle and the one before has been looked at already.
  Start leave(std::uint32_t u, Position from, Position to) const {
    const auto side = [&](std::uint32_t v) { return orientation(from, to, positions_[v]); };
    for (const int step : {1, 2}) {
      std::uint32_t t = some_triangle_[u];
      int known = side(mesh_.triangles[t][(corner_at(t, u) + step) % 3]);
      do {
        const int i = corner_at(t, u);
        const std::uint32_t next = mesh_.triangles[t][(i + 1) % 3], previous = mesh_.triangles[t][(i + 2) % 3];
        const int found = side(step == 1 ? previous : next);
        const int of_next = step == 1 ? known : found, of_previous = step == 1 ? found : known;
        if (of_next == 0 && lies_ahead(from, to, positions_[next])) return {next, t, 0};
        if (of_previous == 0 && lies_ahead(from, to, positions_[previous])) return {previous, t, 0};
        if (of_next < 0 && of_previous > 0) return {kNoTriangle, t, i};
        known = found;
        t = mesh_.neighbours[t][(i + step) % 3];
      } while (t != kNoTriangle && t != some_triangle_[u]);
    }
    throw Error("a walk left the mesh");
  }

  int corner_at(std::uint32_t t, std::uint32_t u) const {
    const auto& v = mesh_.triangles[t];
    return v[0] == u ? 0 : v[1] == u ? 1 : 2;
  }

  const PlaneMesh& mesh_;
  std::vector<Position> positions_;  ///< where the vertices are, close together in memory
  std::vector<std::uint32_t> some_triangle_;
};

}  // namespace itin
