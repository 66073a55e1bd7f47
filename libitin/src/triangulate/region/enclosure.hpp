// Finds triangles that need no proof against unread vertices: lines shut off their circumdiscs from all unknown ground.
//
// Let a circle through an edge's ends grow to the circumcircle of a triangle of a constrained Delaunay triangulation.
// The first vertex beyond the edge that disturbs the triangle is seen from both ends. Lines of sight cross one triangle
// after another by edges that are not constrained. So these edges are followed, in the cone that they leave open
// (triangular expansion). When from one end no cone leads out of the known ground within the circumdisc, no vertex
// beyond disturbs the triangle. Thin triangles along a line have enormous circumdiscs, but see next to nothing of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <itin/geometry.hpp>

#include "triangulate/apex/apex.hpp"
#include "triangulate/apex/apex_frame.hpp"
#include "triangulate/mesh/delaunay.hpp"
#include "triangulate/region/known_ground.hpp"

namespace itin {

/// Tells which triangles are enclosed by known ground. One object serves one thread, and refers to its arguments.
class Enclosure {
 public:
  /// Precondition: the mesh has every vertex and every segment of the known ground, and there is no vertex outside
  /// `all`.
  Enclosure(const PlaneMesh& mesh, std::span<const SelectedVertex> vertices, const KnownGround& known,
            const GridBox& all)
      : mesh_(mesh), vertices_(vertices), known_(known), all_(all) {}

  /// Tells whether triangle t lies in known ground, and surely everything that could disturb it, too. False also where
  /// the answer would take long.
  bool holds(std::uint32_t t);
  /// Adds the cells that holds(t) could not look into, after it was false. Returns false where there are many.
  bool add_missing(std::vector<Cell>& cells) const;

 private:
  /// The cone that an eye sees through an edge of a triangle on this side of it; its directions lie from `right` to
  /// `left`, counterclockwise.
  struct Cone {
    std::uint32_t triangle;
    int edge;
    Position right, left;
  };
  enum class End { kFirst, kSecond };

  Position corner(std::uint32_t t, int i) const { return vertices_[mesh_.triangles[t][i % 3]].position(); }
  bool known(std::uint32_t t, const GridBox& limit, const GridBox& near);
  bool shut_in(std::uint32_t t, int edge, End eye);
  void see_through(std::uint32_t t, int edge, Position right, Position left);
  bool known_beyond_hull(Position eye, const Cone& cone, const GridBox& limit);
  bool follow(Position eye, const ApexFrame& frame, double lambda, const GridBox& limit);

  const PlaneMesh& mesh_;
  std::span<const SelectedVertex> vertices_;
  const KnownGround& known_;
  GridBox all_;
  std::vector<Cone> cones_;
  GridBox unknown_;  ///< the ground near by that was not known at the last failure
};

}  // namespace itin
