// The straight way from one vertex of a mesh to another: the edges it crosses and the vertices it passes through.
#pragma once

#include <vector>

#include <itin/error.hpp>

#include "triangulate/region.hpp"

namespace itin {

class VertexWalk {
 public:
  /// The mesh must cover every segment that is walked.
  explicit VertexWalk(const RegionMesh& region)
      : region_(region), mesh_(region.mesh), some_triangle_(region.vertices.size(), kNoTriangle) {
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
  Position position(std::uint32_t vertex) const { return region_.vertices[vertex].position(); }

  /// Walks from vertex u towards v up to the first vertex on the segment.
  template <class OnEdge>
  std::uint32_t next_vertex(std::uint32_t u, std::uint32_t v, const OnEdge& on_edge) const {
    const Position from = position(u), to = position(v);
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
      const int side = orientation(from, to, position(corners[i]));
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

  Start leave(std::uint32_t u, Position from, Position to) const {
    for (const int turn : {1, 2}) {  // counterclockwise, and clockwise from where a border stopped that
      std::uint32_t t = some_triangle_[u];
      do {
        const auto& v = mesh_.triangles[t];
        const int i = v[0] == u ? 0 : v[1] == u ? 1 : 2, next = (i + 1) % 3, previous = (i + 2) % 3;
        const int after_right = orientation(from, position(v[next]), to),
                  before_left = orientation(from, to, position(v[previous]));
        if (after_right == 0 && ahead(from, position(v[next]), to)) return {v[next], t, 0};
        if (before_left == 0 && ahead(from, position(v[previous]), to)) return {v[previous], t, 0};
        if (after_right > 0 && before_left > 0) return {kNoTriangle, t, i};
        t = mesh_.neighbours[t][(i + turn) % 3];
      } while (t != kNoTriangle && t != some_triangle_[u]);
    }
    throw Error("a walk left the mesh");
  }

  static bool ahead(Position from, Position p, Position to) {
    return (std::int64_t{p.x} - from.x) * (std::int64_t{to.x} - from.x) +
               (std::int64_t{p.y} - from.y) * (std::int64_t{to.y} - from.y) >
           0;
  }

  const RegionMesh& region_;
  const PlaneMesh& mesh_;
  std::vector<std::uint32_t> some_triangle_;
};

}  // namespace itin
