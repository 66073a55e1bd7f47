// Who touches whom in a Tin: all of it is made on demand, and nothing is stored.
//
//   const Tin tin = triangulate(store, Window::disc({318000, 176000}, 500), Detail::tolerance(0), progress);
//   const Topology topology(tin);
//   for (const std::uint32_t neighbour : topology.vertices_of_vertex(0)) std::cout << tin.point(neighbour).z << '\n';
//
// Half-edge 3 t + i runs from corner i of triangle t to the next, with t to its left. Edges are numbered in ascending
// order of their first half-edge. The nine relations of De Floriani and Hui (2005) are asked by name; each costs time
// proportional to its answer, and those that return spans or arrays allocate nothing. Where only the triangles'
// neighbours are wanted, adjacent_triangles() is a fraction of the work.
//
// A vertex may have several fans of triangles, each ending at the boundary on both sides: windows and holes in the
// coverage cut them apart. A vertex at which no fan ends is enclosed by a single closed fan.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <itin/tin.hpp>

namespace itin {

/// Stands for the missing neighbour across a boundary edge in flat arrays.
inline constexpr std::uint32_t kNoNeighbour = 0xffffffff;

/// Returns for each triangle t and i = 0, 1, 2 the triangle across the edge from corner i to corner (i + 1) % 3, or
/// kNoNeighbour. O(n) time, about 40 bytes per triangle while running. Precondition here and below: tin.triangles are
/// those of a planar triangulation, counterclockwise, fewer than 2^32 / 3.
std::vector<std::array<std::uint32_t, 3>> adjacent_triangles(const Tin& tin);

/// The adjacency of a Tin. Immutable and safe for concurrent use. Refers to the Tin, which must outlive it and stay as
/// it is. O(n) to make, about 75 bytes per triangle.
class Topology {
 public:
  explicit Topology(const Tin& tin);
  explicit Topology(const Tin&& tin) = delete;

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(tin_->vertices.size()); }
  std::uint32_t edge_count() const { return static_cast<std::uint32_t>(half_edge_of_edge_.size()); }
  std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(tin_->triangles.size()); }

  // Half-edges.
  std::uint32_t half_edge_count() const { return 3 * triangle_count(); }
  static std::uint32_t face(std::uint32_t h) { return h / 3; }
  static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::uint32_t previous(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  std::uint32_t origin(std::uint32_t h) const { return tin_->triangles[h / 3][h % 3]; }
  std::uint32_t destination(std::uint32_t h) const { return origin(next(h)); }
  /// Returns the half-edge in the other direction; nothing at the boundary.
  std::optional<std::uint32_t> twin(std::uint32_t h) const {
    return twins_[h] == kNoNeighbour ? std::nullopt : std::optional(twins_[h]);
  }
  std::uint32_t edge(std::uint32_t h) const { return edge_of_half_edge_[h]; }
  /// Returns the only half-edge of a boundary edge, else the lesser of two.
  std::uint32_t half_edge(std::uint32_t e) const { return half_edge_of_edge_[e]; }

  bool on_boundary(std::uint32_t vertex) const {
    return vertices_of_vertex(vertex).size() != triangles_of_vertex(vertex).size();
  }

  // These lists run counterclockwise around a vertex. At a boundary vertex they begin at the boundary, so that its fans
  // stay together; the fan of the least triangle among those that begin a fan comes first. At an enclosed vertex they
  // begin at its least triangle.
  std::span<const std::uint32_t> vertices_of_vertex(std::uint32_t v) const {
    return slice(neighbours_, first_neighbour_, v);
  }
  /// Returns the edges to vertices_of_vertex(), in the same order.
  std::span<const std::uint32_t> edges_of_vertex(std::uint32_t v) const { return slice(edges_, first_neighbour_, v); }
  std::span<const std::uint32_t> triangles_of_vertex(std::uint32_t v) const {
    return slice(triangles_, first_triangle_, v);
  }

  // These are incident to an edge.
  /// Returns origin and destination of the edge's half_edge().
  std::array<std::uint32_t, 2> vertices_of_edge(std::uint32_t e) const {
    return {origin(half_edge(e)), destination(half_edge(e))};
  }
  /// Appends the edges that share a vertex with e: counterclockwise after e about its origin, then its destination.
  void edges_of_edge(std::uint32_t e, std::vector<std::uint32_t>& out) const;
  /// Returns the triangles to the left and to the right of half_edge(); nothing to the right of a boundary edge.
  std::array<std::optional<std::uint32_t>, 2> triangles_of_edge(std::uint32_t e) const;

  // These are incident to a triangle; entry i belongs to corner i, or to the edge from corner i to the next.
  const std::array<std::uint32_t, 3>& vertices_of_triangle(std::uint32_t t) const { return tin_->triangles[t]; }
  std::array<std::uint32_t, 3> edges_of_triangle(std::uint32_t t) const {
    return {edge_of_half_edge_[3 * t], edge_of_half_edge_[3 * t + 1], edge_of_half_edge_[3 * t + 2]};
  }
  std::array<std::optional<std::uint32_t>, 3> triangles_of_triangle(std::uint32_t t) const;

 private:
  static std::span<const std::uint32_t> slice(const std::vector<std::uint32_t>& items,
                                              const std::vector<std::uint32_t>& first, std::uint32_t v) {
    return std::span(items).subspan(first[v], first[v + 1] - first[v]);
  }
  void number_edges();
  void group_by_origin(std::vector<std::uint32_t>& outgoing);
  void order_stars(std::vector<std::uint32_t>& outgoing);

  const Tin* tin_;
  std::vector<std::uint32_t> twins_;  ///< by half-edge; kNoNeighbour at the boundary
  std::vector<std::uint32_t> edge_of_half_edge_;
  std::vector<std::uint32_t> half_edge_of_edge_;
  // Vertex v has the entries [first[v], first[v + 1]).
  std::vector<std::uint32_t> first_triangle_, triangles_;
  std::vector<std::uint32_t> first_neighbour_, neighbours_, edges_;
};

}  // namespace itin
