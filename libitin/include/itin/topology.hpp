// Who touches whom in a Tin: all of it is made on demand, and nothing is stored.
//
//   const Tin tin = triangulate(store, Window::disc({318000, 176000}, 500), Detail::tolerance(0), progress);
//   const Topology topology(tin);
//   for (const std::uint32_t neighbour : topology.vertices_of_vertex(0)) std::cout << tin.point(neighbour).z << '\n';
//
// Half-edge 3 t + i runs from corner i of triangle t to the next, with t to its left. Each question costs time
// proportional to its answer and allocates nothing. Where only the triangles' neighbours are wanted,
// adjacent_triangles() is a fraction of the work.
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
/// it is. O(n) to make, about 40 bytes per triangle.
class Topology {
 public:
  explicit Topology(const Tin& tin);
  explicit Topology(const Tin&& tin) = delete;

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(tin_->vertices.size()); }
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

  /// Tells whether a fan of triangles ends at the vertex.
  bool on_boundary(std::uint32_t vertex) const {
    return vertices_of_vertex(vertex).size() != first_triangle_[vertex + 1] - first_triangle_[vertex];
  }

  /// Returns the neighbours of a vertex, counterclockwise. At a boundary vertex they begin at the boundary, so that its
  /// fans stay together; the fan of the least triangle among those that begin a fan comes first. At an enclosed vertex
  /// they begin at its least triangle.
  std::span<const std::uint32_t> vertices_of_vertex(std::uint32_t v) const {
    return std::span(neighbours_).subspan(first_neighbour_[v], first_neighbour_[v + 1] - first_neighbour_[v]);
  }

 private:
  void group_by_origin(std::vector<std::uint32_t>& outgoing);
  void order_stars(std::vector<std::uint32_t>& outgoing);

  const Tin* tin_;
  std::vector<std::uint32_t> twins_;  ///< by half-edge; kNoNeighbour at the boundary
  // Vertex v has the entries [first[v], first[v + 1]): of half-edges that leave it, a triangle each, and of neighbours.
  std::vector<std::uint32_t> first_triangle_, first_neighbour_, neighbours_;
};

}  // namespace itin
