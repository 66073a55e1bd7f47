// The hierarchy of right triangles over a lattice of posts with equal steps (Evans, Kirkpatrick and Townsend 2001).
//
// Every 64th column and row bounds a block, which is a square of two right triangles. A right triangle is halved by its
// apex and the post in the middle of its longest side, until its legs are one step long; the triangle beyond that side
// is halved with it. So each post but the corners of blocks is in the middle of one square, made of these two
// triangles, and needs the square's corners. A set of posts is closed when it has the corners of its posts' squares. It
// has one triangulation into such triangles. This is its Delaunay triangulation, as the circle about a right triangle
// passes through the square's corners and holds no other post of the set; which diagonal halves a square whose middle
// the set lacks is for the tie rule to say (predicates.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "geometry/post_lattice.hpp"

namespace itin {

/// The side of a block in steps of the lattice.
inline constexpr std::int32_t kBlockSide = 64;

/// How a square lies about the post in its middle.
enum class SquareKind : std::uint8_t {
  kLevel,    ///< its sides lie along columns and rows
  kOnRow,    ///< its diagonals do; its halves share a side of level squares that lies along the post's row
  kOnColumn  ///< its diagonals do; its halves share such a side along the post's column
};

/// The square that has a post in its middle.
struct PostSquare {
  SquareKind kind = SquareKind::kLevel;
  std::int64_t half = 0;  ///< half of the side of a level square, half of the diagonal of another; 0: there is none
};

/// Returns the square about the post at this place; none for a corner of a block.
inline PostSquare square_about(const LatticePlace& place) {
  const auto divisor = [](std::int64_t v) { return (v | kBlockSide) & -(v | kBlockSide); };
  const std::int64_t of_column = divisor(place.column), of_row = divisor(place.row);
  if (of_column < of_row) return {SquareKind::kOnRow, of_column};
  if (of_row < of_column) return {SquareKind::kOnColumn, of_row};
  return {SquareKind::kLevel, of_column == kBlockSide ? 0 : of_column};
}

/// Returns the middles of the level squares that the halves of a square lie in; for a level square this is its own.
inline std::array<LatticePlace, 2> halves_of(const LatticePlace& middle, const PostSquare& square) {
  const auto& [c, r] = middle;
  switch (square.kind) {
    case SquareKind::kOnRow:
      return {{{c, r - square.half}, {c, r + square.half}}};
    case SquareKind::kOnColumn:
      return {{{c - square.half, r}, {c + square.half, r}}};
    default:
      return {{middle, middle}};
  }
}

/// Returns the corners that a post needs of one half of its square, given as halves_of() gives it.
inline std::array<LatticePlace, 4> corners_in_half(const LatticePlace& middle, const PostSquare& square,
                                                   const LatticePlace& half) {
  const auto& [c, r] = middle;
  const std::int64_t h = square.half;
  switch (square.kind) {
    case SquareKind::kOnRow:
      return {{{c - h, r}, {c + h, r}, half, half}};
    case SquareKind::kOnColumn:
      return {{{c, r - h}, {c, r + h}, half, half}};
    default:
      return {{{c - h, r - h}, {c + h, r - h}, {c + h, r + h}, {c - h, r + h}}};
  }
}

}  // namespace itin
