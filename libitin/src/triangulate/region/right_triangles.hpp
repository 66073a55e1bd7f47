// Right triangles on a lattice's posts, which need no triangulation (geometry/right_hierarchy.hpp).
//
//   const RightTriangles triangles(positions, segments, known);
//
// Fine levels of rasters are closed sets of posts (pyramid/levels/post_hierarchy.hpp). Wherever a set of posts is
// closed within squares that hold nothing else, its right triangles are Delaunay triangles, if the circles about them
// stay within these squares. Nothing is taken on trust: whether a square's posts are closed is seen when its triangles
// are listed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/marked_squares.hpp"
#include "geometry/post_lattice.hpp"
#include "geometry/right_hierarchy.hpp"
#include "store/codec/point_index.hpp"
#include "triangulate/mesh/known_triangles.hpp"

namespace itin {

class RightTriangles final : public KnownTriangles {
 public:
  /// Takes all positions and segments within `known`, and perhaps others. Positions are in Morton order.
  RightTriangles(std::span<const Position> positions, std::span<const Segment> segments, const GridBox& known);

  std::uint32_t triangle_count() const override { return static_cast<std::uint32_t>(faces_.size()); }
  const std::vector<std::uint32_t>& rest() const override { return rest_; }
  void fill(PlaneMesh& mesh) const override;

 private:
  static constexpr std::uint32_t kNone = kNoTriangle;
  static constexpr std::size_t kDirections = 8;
  /// A post, by its column and row counted from the lower left post of all blocks.
  struct Post {
    std::int32_t column = -1, row = -1;
    friend bool operator==(const Post&, const Post&) = default;
  };
  /// Corners counterclockwise; the right angle comes first.
  using Face = std::array<Post, 3>;
  /// A level square, by its lower left post and the length of its sides.
  struct Square {
    std::int32_t column, row, side;
  };

  bool place(std::span<const Position> positions);
  void find_bare_squares(std::span<const Position> positions, std::span<const Segment> segments, const GridBox& known);
  template <class Met>
  void spoil(const GridBox& box, const Met& met);
  static std::array<Face, 2> halves_of(const Square& square);
  void find_closed(const Square& square);
  bool is_closed(const Square& square) const;
  std::size_t halvings(const Face& face, const Square& square) const;
  void count_open_squares();
  void list(const Face& face, const Square& square);
  bool has_known_circle(const Face& face, const Square& square) const;
  void note_edges();
  void note_edges(std::uint32_t face);
  void break_ties();
  void find_rest();

  std::size_t post(const Post& p) const {
    return static_cast<std::size_t>(p.row) * static_cast<std::size_t>(across_ + 1) + static_cast<std::size_t>(p.column);
  }
  std::size_t square(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(column);
  }
  std::uint32_t vertex(const Post& p) const { return vertices_[post(p)]; }
  bool has(const Post& p) const { return vertex(p) != kNone; }
  std::optional<Post> halver(const Face& face) const;
  GridBox box_of_square(std::int32_t column, std::int32_t row) const;
  std::size_t edge(const Post& from, const Post& to) const;
  std::uint32_t face_left_of(std::uint32_t from, std::uint32_t to) const;
  std::vector<std::uint8_t> covered_by_faces(const PlaneMesh& mesh) const;

  PostLattice lattice_;                  ///< its first place is the lower left post of the lower left block
  std::int32_t across_ = 0, up_ = 0;     ///< the number of single squares
  std::vector<Post> posts_;              ///< by position; none for positions off the lattice
  std::vector<std::uint32_t> vertices_;  ///< by post: the position's index, or kNone
  std::vector<std::uint8_t> bare_;       ///< by single square: it is known, and nothing but posts is in it
  std::vector<Square> closed_;           ///< the greatest squares whose posts are closed
  MarkedSquares open_;                   ///< the single squares that are in none of them
  std::vector<Face> faces_;
  std::vector<std::uint32_t> left_of_;  ///< by position and direction: the face left of the edge that leaves there
  std::vector<std::uint32_t> rest_;
};

}  // namespace itin
