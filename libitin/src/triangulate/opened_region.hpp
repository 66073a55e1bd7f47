// The region of a surface that opens where tops of features go: the triangles that have one for a corner.
//
// A triangle that another feature has a corner of, too, is not of the region. It is the other feature's wall, which
// stays, and its tops that go are lowered to the ground instead of removed.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/tin.hpp>

#include "geometry/cell.hpp"
#include "geometry/predicates.hpp"
#include "triangulate/mesh/box_index.hpp"

namespace itin {

/// Two positions in ascending order.
using PlanEdge = std::pair<Position, Position>;

inline PlanEdge plan_edge(Position a, Position b) {
  return a < b ? PlanEdge{a, b} : PlanEdge{b, a};
}
inline GridBox extent_of(const PlanEdge& e) {
  return {e.first.x, std::min(e.first.y, e.second.y), e.second.x, std::max(e.first.y, e.second.y)};
}
/// Tells whether the edges have a point in common that is an end of neither and not on both as a whole.
bool cross(const PlanEdge& e, const PlanEdge& f);

class OpenedRegion {
 public:
  enum class Side : std::uint8_t { outside, border, inside };

  /// What a vertex of the surface is: a top that goes, a top of another feature, or on the ground.
  enum class Vertex : std::uint8_t { top, other, ground };

  /// Takes the triangles of `surface` about its tops; kind_of(v) tells what a vertex is.
  template <class KindOf>
  OpenedRegion(const Tin& surface, const KindOf& kind_of);

  /// The codes of the tops that are removed and of those that are lowered, each ascending.
  const std::vector<std::uint64_t>& removed() const { return removed_; }
  const std::vector<std::uint64_t>& lowered() const { return lowered_; }
  /// The edges that stay, ascending: the region's border, what divides it on the ground, and the walls of others.
  const std::vector<PlanEdge>& borders() const { return borders_; }
  /// The codes of their ends on the ground, ascending.
  const std::vector<std::uint64_t>& feet() const { return feet_; }
  std::vector<GridBox> boxes_of_triangles() const;

  /// Tells where the middle between two positions lies.
  Side side_of_middle(const Position& a, const Position& b) const;
  Side side_of(const Position& p) const { return side_of_middle(p, p); }
  /// Calls visit(edge) for each of the borders whose box meets the box.
  template <class Visit>
  void for_each_border(const GridBox& box, const Visit& visit) const {
    borders_near_.for_each(box, [&](std::uint32_t i) { visit(borders_[i]); });
  }

 private:
  using Corners = std::array<Position, 3>;
  struct SidedEdge {
    PlanEdge edge;
    bool on_ground = false;  ///< no top ends it
    friend auto operator<=>(const SidedEdge&, const SidedEdge&) = default;
  };
  void finish(std::vector<SidedEdge> edges);

  std::vector<Corners> triangles_;
  std::vector<std::uint64_t> removed_, lowered_, feet_;
  std::vector<PlanEdge> borders_;
  BoxIndex triangles_near_, borders_near_;
};

template <class KindOf>
OpenedRegion::OpenedRegion(const Tin& surface, const KindOf& kind_of) {
  std::vector<SidedEdge> edges;
  for (const Triangle& t : surface.triangles) {
    std::array<Vertex, 3> kinds{};
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) {
      kinds[i] = kind_of(t[i]);
      corners[i] = {surface.vertices[t[i]].x, surface.vertices[t[i]].y};
    }
    const auto has = [&](Vertex kind) { return std::find(kinds.begin(), kinds.end(), kind) != kinds.end(); };
    if (!has(Vertex::top)) continue;
    const bool of_other = has(Vertex::other);
    if (!of_other) triangles_.push_back(corners);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const PlanEdge edge = plan_edge(corners[i], corners[j]);
      if (kinds[i] == Vertex::top) (of_other ? lowered_ : removed_).push_back(code_of(corners[i]));
      if (kinds[i] != Vertex::other) feet_.push_back(code_of(corners[i]));
      if (of_other) {
        borders_.push_back(edge);
      } else {
        edges.push_back({edge, kinds[i] != Vertex::top && kinds[j] != Vertex::top});
      }
    }
  }
  finish(std::move(edges));
}

}  // namespace itin
