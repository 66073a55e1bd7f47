// Quadtree cells and the Morton curve that orders every point of a store.
//
// The root is the square [-2^29, 2^29)^2 of the grid. A cell is an aligned square of side 2^log2_side; its code is the
// Morton code of its lower left corner, and its points are exactly those with codes in [code, end()).
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/precondition.hpp>

#include "geometry/predicates.hpp"

namespace itin {

inline constexpr int kRootLog2Side = 30;

namespace detail_morton {

/// Spreads the low 32 bits of v to the even bits of the result.
constexpr std::uint64_t spread(std::uint64_t v) {
  v &= 0xffffffffu;
  v = (v | (v << 16)) & 0x0000ffff0000ffffu;
  v = (v | (v << 8)) & 0x00ff00ff00ff00ffu;
  v = (v | (v << 4)) & 0x0f0f0f0f0f0f0f0fu;
  v = (v | (v << 2)) & 0x3333333333333333u;
  v = (v | (v << 1)) & 0x5555555555555555u;
  return v;
}

/// Does the inverse of spread().
constexpr std::uint32_t gather(std::uint64_t v) {
  v &= 0x5555555555555555u;
  v = (v | (v >> 1)) & 0x3333333333333333u;
  v = (v | (v >> 2)) & 0x0f0f0f0f0f0f0f0fu;
  v = (v | (v >> 4)) & 0x00ff00ff00ff00ffu;
  v = (v | (v >> 8)) & 0x0000ffff0000ffffu;
  v = (v | (v >> 16)) & 0x00000000ffffffffu;
  return static_cast<std::uint32_t>(v);
}

}  // namespace detail_morton

/// Returns the Morton code, 60 bits: x in the even bits, y in the odd ones. Precondition: both in [-2^29, 2^29).
constexpr std::uint64_t morton(std::int32_t x, std::int32_t y) {
  ITIN_PRECONDITION(x >= -kGridHalfSide && x < kGridHalfSide && y >= -kGridHalfSide && y < kGridHalfSide);
  return detail_morton::spread(static_cast<std::uint32_t>(x + kGridHalfSide)) |
         (detail_morton::spread(static_cast<std::uint32_t>(y + kGridHalfSide)) << 1);
}
constexpr std::uint64_t code_of(const GridPoint& p) {
  return morton(p.x, p.y);
}
constexpr std::uint64_t code_of(const Position& p) {
  return morton(p.x, p.y);
}
/// The order of points in a store.
constexpr bool before_by_code(const GridPoint& p, const GridPoint& q) {
  return code_of(p) < code_of(q);
}
/// Returns the point with this code among points in the order of a store, or their end.
template <class Points>
auto find_by_code(const Points& points, std::uint64_t code) {
  const auto at = std::lower_bound(points.begin(), points.end(), code,
                                   [](const auto& p, std::uint64_t c) { return code_of(p) < c; });
  return at != points.end() && code_of(*at) == code ? at : points.end();
}
/// Tells whether a code is among ascending ones.
inline bool has_code(const std::vector<std::uint64_t>& codes, std::uint64_t code) {
  return std::binary_search(codes.begin(), codes.end(), code);
}
constexpr std::int32_t morton_x(std::uint64_t code) {
  return static_cast<std::int32_t>(detail_morton::gather(code)) - kGridHalfSide;
}
constexpr std::int32_t morton_y(std::uint64_t code) {
  return static_cast<std::int32_t>(detail_morton::gather(code >> 1)) - kGridHalfSide;
}
constexpr Position position_of(std::uint64_t code) {
  return {morton_x(code), morton_y(code)};
}

struct Cell {
  std::uint64_t code = 0;
  int log2_side = kRootLog2Side;

  constexpr std::uint64_t end() const { return code + (std::uint64_t{1} << (2 * log2_side)); }
  constexpr bool contains(std::uint64_t morton_code) const { return morton_code >= code && morton_code < end(); }
  constexpr bool contains(const Cell& c) const { return c.code >= code && c.end() <= end(); }
  /// Returns all grid positions of the cell, as a closed box.
  constexpr GridBox box() const {
    const std::int32_t x = morton_x(code), y = morton_y(code);
    const auto last = static_cast<std::int32_t>((std::int64_t{1} << log2_side) - 1);
    return {x, y, x + last, y + last};
  }
  /// Returns the quarter i of the cell: lower left, lower right, upper left, upper right for i = 0..3.
  constexpr Cell child(int i) const {
    return {code + (static_cast<std::uint64_t>(i) << (2 * (log2_side - 1))), log2_side - 1};
  }
  constexpr Cell parent() const { return {code & ~((std::uint64_t{1} << (2 * (log2_side + 1))) - 1), log2_side + 1}; }
  friend constexpr auto operator<=>(const Cell&, const Cell&) = default;
};

/// Returns the cell's square in the plane, which reaches up to the next cell's first positions.
constexpr GridBox square_of(const Cell& cell) {
  const GridBox box = cell.box();
  return {box.xmin, box.ymin, box.xmax + 1, box.ymax + 1};
}

}  // namespace itin
