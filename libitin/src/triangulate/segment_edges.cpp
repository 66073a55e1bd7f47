#include "triangulate/segment_edges.hpp"

namespace itin {

namespace {

class Layer {
 public:
  Layer(PlaneMesh& mesh, std::span<const SelectedVertex> vertices)
      : mesh_(mesh), vertices_(vertices), some_triangle_(vertices.size(), kNoTriangle) {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh_.triangles[t]) some_triangle_[v] = t;
    }
  }

  /// Appends the segment's edges. False when it is not made of edges.
  bool lay(const Delaunay::Constraint& segment, std::uint16_t theme, std::vector<SegmentEdge>& edges) {
    const auto [from, to] = segment;
    for (std::uint32_t at = from; at != to;) {
      if (some_triangle_[at] == kNoTriangle) return false;
      std::optional<SegmentEdge> edge = edge_towards(at, to, some_triangle_[at]);
      if (!edge) return false;
      edge->theme = theme;
      mark_constrained(*edge);
      edges.push_back(*edge);
      at = edge->to;
    }
    return true;
  }

 private:
  Position position(std::uint32_t vertex) const { return vertices_[vertex].position(); }

  void mark_constrained(const SegmentEdge& edge) {
    for (const std::uint32_t t : {edge.left, edge.right}) {
      if (t == kNoTriangle) continue;
      for (int i = 0; i < 3; ++i) {
        if (mesh_.triangles[t][i] != edge.from && mesh_.triangles[t][i] != edge.to) {
          mesh_.constrained[t] |= static_cast<std::uint8_t>(1 << i);
          if (edge.theme == kCoverage)
            mesh_.constrained[t] |= static_cast<std::uint8_t>(1 << (i + PlaneMesh::kOutline));
        }
      }
    }
  }

  /// The edge that leaves vertex `at` straight towards vertex `to`, if there is one.
  std::optional<SegmentEdge> edge_towards(std::uint32_t at, std::uint32_t to, std::uint32_t start) const {
    const Position p = position(at), goal = position(to);
    const auto leads = [&](std::uint32_t v) {
      const Position q = position(v);
      return orientation(p, q, goal) == 0 && (std::int64_t{q.x} - p.x) * (std::int64_t{goal.x} - p.x) +
                                                     (std::int64_t{q.y} - p.y) * (std::int64_t{goal.y} - p.y) >
                                                 0;
    };
    for (const int turn : {1, 2}) {  // counterclockwise, and clockwise from where the hull stopped that
      std::uint32_t t = start;
      do {
        const auto& v = mesh_.triangles[t];
        const int i = v[0] == at ? 0 : v[1] == at ? 1 : 2, next = (i + 1) % 3, previous = (i + 2) % 3;
        if (leads(v[next])) return SegmentEdge{at, v[next], t, mesh_.neighbours[t][previous]};
        if (leads(v[previous])) return SegmentEdge{at, v[previous], mesh_.neighbours[t][next], t};
        t = mesh_.neighbours[t][(i + turn) % 3];
      } while (t != kNoTriangle && t != start);
    }
    return std::nullopt;
  }

  PlaneMesh& mesh_;
  std::span<const SelectedVertex> vertices_;
  std::vector<std::uint32_t> some_triangle_;
};

}  // namespace

std::optional<std::vector<SegmentEdge>> lay_segments(PlaneMesh& mesh, std::span<const SelectedVertex> vertices,
                                                     std::span<const Delaunay::Constraint> segments,
                                                     std::span<const std::uint16_t> themes) {
  std::vector<SegmentEdge> edges;
  mesh.constrained.assign(mesh.triangles.size(), 0);
  if (segments.empty()) return edges;
  Layer layer(mesh, vertices);
  for (std::size_t k = 0; k < segments.size(); ++k) {
    if (!layer.lay(segments[k], themes[k], edges)) return std::nullopt;
  }
  return edges;
}

}  // namespace itin
