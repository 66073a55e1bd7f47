// Triangles that need no proof against vertices not read: lines shut off their circumdiscs from all unknown ground.
//
// The first vertex beyond an edge that disturbs a triangle of a constrained Delaunay triangulation, as a circle through
// the edge's ends grows to the triangle's own, is seen from both ends. Lines of sight cross one triangle after another
// by edges that are not constrained. So those are followed, in the cone that they leave open (triangular expansion),
// and when from one end no cone leads out of the known ground within the circumdisc, there is nothing beyond. Thin
// triangles along a line have enormous circumdiscs, of which they see next to nothing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <itin/geometry.hpp>

#include "triangulate/apex.hpp"
#include "triangulate/apex_frame.hpp"
#include "triangulate/delaunay.hpp"
#include "triangulate/known_ground.hpp"

namespace itin {

/// One serves one thread. Refers to what it is made of.
class Enclosure {
 public:
  /// The mesh has every vertex and every segment of the known ground. There is no vertex outside `all`.
  Enclosure(const PlaneMesh& mesh, std::span<const SelectedVertex> vertices, const KnownGround& known,
            const GridBox& all)
      : mesh_(mesh), vertices_(vertices), known_(known), all_(all) {}

  /// Whether triangle t lies in known ground, and surely all that could disturb it too. False also where it takes long
  /// to tell.
  bool holds(std::uint32_t t);
  /// After holds(t) was false: adds the cells into which it could not look. False where those are many.
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
  GridBox unknown_;  ///< the ground that the last failure lacked, as far as it is near
};

}  // namespace itin
