// The flat triangles of contours: three vertices at one height, all on contours. They are an artefact of the contours,
// for ground seldom is level across a bend of a contour (J. M. Ware, A procedure for automatically correcting invalid
// flat triangles occurring in triangulated contour data, Computers & Geosciences, 1998).
//
//   FlatTriangles flat(std::move(level_edges));
//   for (const FlatTriangles::Region& region : flat.regions()) ...
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <itin/geometry.hpp>

#include "triangulate/mesh/delaunay.hpp"

namespace itin {

/// An edge between two contour vertices of one height, as one of the triangles at it sees it.
struct LevelEdge {
  GridPoint a, b;      ///< the one with the lesser Morton code first
  GridPoint opposite;  ///< the triangle's third vertex
  bool constrained = false;
  bool flat = false;                 ///< whether the triangle is flat
  bool opposite_on_contour = false;  ///< whether `opposite` is on a contour, and so tells the contour interval
};

class FlatTriangles {
 public:
  enum class Passage : std::uint8_t {
    kClosed,  ///< a contour, or the border of the ground
    kFlat,    ///< another flat triangle of the region is beyond
    kExit,    ///< the region ends here, and the ground beyond rises or falls to a vertex
  };
  struct Side {
    Passage passage = Passage::kClosed;
    bool ground_beyond = false;
    bool contour_beyond = false;           ///< whether vertex `beyond` is on a contour
    std::uint32_t triangle = kNoTriangle;  ///< the triangle beyond, if it is flat as well and no line lies between
    GridPoint beyond;                      ///< the third vertex of the triangle beyond
  };
  struct Triangle {
    std::array<GridPoint, 3> corners;  ///< in Morton order
    std::array<Side, 3> sides;         ///< side i is opposite corner i
  };
  /// Triangles that are connected through their sides, ascending.
  using Region = std::vector<std::uint32_t>;

  /// Takes the edges in any order, each triangle's edges once. The result depends on the set alone.
  explicit FlatTriangles(std::vector<LevelEdge> edges);

  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<Region>& regions() const { return regions_; }

 private:
  void find_triangles(const std::vector<LevelEdge>& edges);
  void join(std::span<const LevelEdge> at_edge);
  void find_regions();
  std::uint32_t number_of(const LevelEdge& edge) const;

  std::vector<Triangle> triangles_;
  std::vector<Region> regions_;
};

}  // namespace itin
