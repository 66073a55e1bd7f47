// Squares of a lattice of posts, which need no triangulation.
//
//   const LatticeSquares squares(positions, segments, known);
//   delaunay.insert(the positions of squares.rest());   // and whatever else turns up outside `known`
//   PlaneMesh mesh = delaunay.mesh();
//   squares.fill(mesh);                                  // now as if all positions had been inserted
//
// Rasters are lattices: posts stand where columns and rows cross, at whatever distances from each other. The circle
// about a square (or rectangle) between neighbouring columns and rows has no other crossing in or on it. Suppose that
// all four posts are there, no other vertex lies in the circle and no segment comes between them. Then two triangles of
// the constrained Delaunay triangulation are known, on either side of the diagonal that the tie rule of predicates.hpp
// chooses: from lower right to upper left. Elsewhere, as beside voids, coasts and streets, the triangulation of all
// vertices not wholly surrounded by such squares has the same triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <itin/geometry.hpp>

#include "store/codec/point_index.hpp"
#include "triangulate/mesh/known_triangles.hpp"

namespace itin {

class LatticeSquares final : public KnownTriangles {
 public:
  /// Takes all positions and segments within `known`, and perhaps others. Where there are few squares, finds none.
  LatticeSquares(std::span<const Position> positions, std::span<const Segment> segments, const GridBox& known);

  std::uint32_t triangle_count() const override { return count_; }
  const std::vector<std::uint32_t>& rest() const override { return rest_; }
  void fill(PlaneMesh& mesh) const override;

 private:
  static constexpr std::uint32_t kNone = kNoTriangle;
  struct Node {
    std::uint32_t column = kNone, row = kNone;
    bool exists() const { return row != kNone; }
  };

  bool place(std::span<const Position> positions);
  void mark_full(const GridBox& known);
  void clear_about(Position p);
  void clear_along(const Segment& segment);
  void number_triangles();
  void find_rest(std::span<const Segment> segments);

  std::size_t node(std::size_t column, std::size_t row) const { return row * columns_.size() + column; }
  std::size_t node_at(Position p) const;
  bool covers(const std::array<std::uint32_t, 3>& triangle) const;
  void add_squares(PlaneMesh& mesh) const;
  void link(PlaneMesh& mesh, std::uint32_t triangle, unsigned edge) const;

  std::vector<std::int32_t> columns_, rows_;     ///< ascending
  std::int32_t column_step_ = 0, row_step_ = 0;  ///< the usual distance apart
  std::vector<std::uint32_t> vertices_;          ///< by node: the position's index, or kNone
  std::vector<Node> nodes_;                      ///< by position
  std::vector<std::uint32_t> first_;  ///< by node: the first triangle of the square to its upper right, or kNone
  std::vector<std::uint32_t> rest_;
  std::uint32_t count_ = 0;
};

}  // namespace itin
