// A constrained Delaunay triangulation that takes in single vertices and segments in place. Only the triangles that
// must change do, and these are known.
//
//   GrowingMesh grown(vertices);           // by number; others may join later
//   grown.start(delaunay.mesh());          // up to its convex hull
//   grown.lay(0, 17, theme);               // segments meet at vertices only
//   vertices.push_back(v), grown.insert(number of v);
//
// The triangles that a new vertex disturbs are those whose circumcircles it lies in, as far as they are connected
// without a constrained edge between them (A. Bowyer, D. Watson 1981). The triangles that a segment crosses make way
// for the triangulations of the two polygons at its sides (M. Anglada 1997). Ties are broken by predicates.hpp, so the
// mesh is the one that CGAL makes of the same vertices and segments.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "triangulate/apex/apex.hpp"
#include "triangulate/mesh/delaunay.hpp"

namespace itin {

/// An edge of the mesh along a segment, in its direction; kNoTriangle beyond the hull.
struct SegmentEdge {
  std::uint32_t from, to;
  std::uint32_t left, right;
  std::uint16_t theme = kCoverage;
};

class GrowingMesh {
 public:
  /// Refers to the vertices, which must outlive the mesh.
  explicit GrowingMesh(const std::vector<SelectedVertex>& vertices) : vertices_(vertices) {}

  /// Begins anew. Precondition: the mesh has no constraints, and all vertices are in it or, where it is empty, none.
  void start(PlaneMesh mesh);
  /// Inserts a vertex where there is none yet. Precondition: there are triangles.
  void insert(std::uint32_t vertex);
  /// Inserts it where a triangle is known that holds its position.
  void insert(std::uint32_t vertex, std::uint32_t triangle);
  /// Lays a segment. Throws Error where it crosses another. Precondition: there are triangles, and their vertices
  /// include both ends.
  void lay(std::uint32_t from, std::uint32_t to, std::uint16_t theme);

  const PlaneMesh& mesh() const { return mesh_; }
  bool has(std::uint32_t vertex) const {
    return vertex < some_triangle_.size() && some_triangle_[vertex] != kNoTriangle;
  }
  /// Tells whether there is an edge between two vertices of the mesh.
  bool has_edge(std::uint32_t from, std::uint32_t to) const;
  /// Returns a triangle that holds a position. `near` is a triangle to begin at; else the search begins at the last
  /// change. Precondition: the position lies within the hull.
  std::uint32_t triangle_at(Position p, std::uint32_t near) { return locate(p, near).triangle; }
  std::uint32_t triangle_at(Position p) { return locate(p, last_).triangle; }
  /// Returns a triangle at a vertex of the mesh.
  std::uint32_t triangle_of(std::uint32_t vertex) const { return some_triangle_[vertex]; }
  /// The triangles that the last insertion replaced. Their numbers are those of new ones now.
  std::span<const std::uint32_t> replaced() const { return cavity_; }
  /// The triangles about the vertex of the last insertion. The vertex is the last of their corners.
  std::span<const std::uint32_t> star() const { return star_; }
  /// Appends the edges that a segment laid earlier is made of.
  void edges_of(std::uint32_t from, std::uint32_t to, std::uint16_t theme, std::vector<SegmentEdge>& edges) const;

  /// Tells whether a triangle needs no more proof. The mark goes when the triangle changes.
  bool is_proved(std::uint32_t triangle) const { return proved_[triangle] != 0; }
  void mark_proved(std::uint32_t triangle) { proved_[triangle] = 1; }
  /// Returns the triangles that are new or changed since the last call, or since start(), ascending.
  std::vector<std::uint32_t> take_changed();

 private:
  using Corners = std::array<std::uint32_t, 3>;
  /// An edge, with the place to its left, and its properties.
  struct Side {
    std::uint32_t from, to;
    std::uint32_t outer;  ///< the triangle to its right
    std::uint8_t bits;    ///< kLine and kOutline
  };
  struct HalfEdge {
    std::uint32_t from, to, triangle;
    int edge;
  };
  /// The triangle that holds a position, or the one on the hull that the position lies beyond.
  struct Place {
    std::uint32_t triangle;
    int beyond;  ///< the edge that the position lies beyond, or kInside
  };
  static constexpr int kInside = -1;
  static constexpr std::uint8_t kLine = 1, kOutline = 1 << PlaneMesh::kOutline, kTaken = 0x80;

  Position position(std::uint32_t vertex) const { return vertices_[vertex].position(); }
  std::uint32_t corner(std::uint32_t t, int i) const { return mesh_.triangles[t][i % 3]; }
  Position at_corner(std::uint32_t t, int i) const { return position(corner(t, i)); }
  std::uint8_t bits(std::uint32_t t, int edge) const { return (mesh_.constrained[t] >> edge) & (kLine | kOutline); }
  bool taken(std::uint32_t t) const { return (mesh_.constrained[t] & kTaken) != 0; }
  Side side(std::uint32_t t, int edge) const;
  int edge_between(std::uint32_t t, std::uint32_t from, std::uint32_t to) const;
  bool disturbs(Position p, std::uint32_t t) const;
  template <class Visit>
  bool visit_around(std::uint32_t vertex, const Visit& visit) const;
  SegmentEdge edge_towards(std::uint32_t at, std::uint32_t to) const;

  Place locate(Position p, std::uint32_t near);
  void insert(std::uint32_t vertex, const Place& place);
  void clear();
  void take(std::uint32_t t);
  void take_beyond_hull(const Place& place, std::uint32_t vertex);
  void split_edge_at(std::uint32_t vertex);
  void take_disturbed(Position p);
  void fan_out(std::uint32_t vertex);
  void add_side(const Side& side, std::uint32_t vertex);
  void cut(std::uint32_t at, std::uint32_t to, std::uint32_t first);
  void fill_between(std::uint32_t from, std::uint32_t to, std::span<const std::uint32_t> chain);
  void replace();
  void replace_by_star(std::uint32_t vertex);
  std::uint32_t place_for(std::size_t number);

  const std::vector<SelectedVertex>& vertices_;
  PlaneMesh mesh_;
  std::vector<std::uint32_t> some_triangle_;  ///< by vertex
  std::vector<std::uint8_t> proved_;
  std::vector<std::uint32_t> changed_;  ///< some of them more than once
  std::uint32_t last_ = 0;              ///< a triangle near the last change
  std::uint32_t random_ = 0;
  // These are buffers for the part that is being replaced, kept for their memory.
  std::vector<std::uint32_t> cavity_, star_, left_, right_;
  std::vector<Side> rim_;     ///< after insertions, one for each of filling_
  std::vector<Side> halves_;  ///< the halves of a line that the vertex lies on, both ways
  std::vector<Corners> filling_;
  std::vector<HalfEdge> half_edges_;
};

}  // namespace itin
