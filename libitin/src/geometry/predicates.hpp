// Exact predicates on grid positions, and the one rule that breaks ties between cocircular points.
//
// |coordinate| <= 2^29, so differences fit in 31 bits, orientation in 63 and in_circle in 124. A double filter stands
// in front of the 128-bit evaluation.
//
// Tie rule: the lift of a point to the paraboloid is perturbed by an infinitesimal that grows with the lexicographic
// order of (x, y), as in CGAL (O. Devillers and M. Teillaud, Perturbations for Delaunay and weighted Delaunay 3D
// triangulations, 2011). It depends on the positions alone, so every subset, window and order of insertion agrees.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <itin/int128.hpp>

namespace itin {

/// Any type with integer members x and y.
template <class P>
concept GridPosition = requires(const P& p) {
  {
    p.x + std::int64_t {
      0
    }
    } -> std::same_as<std::int64_t>;
  {
    p.y + std::int64_t {
      0
    }
    } -> std::same_as<std::int64_t>;
};

/// A bare grid position.
struct Position {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend auto operator<=>(const Position&, const Position&) = default;
};

/// Tells whether two positions on the grid are equal.
template <GridPosition A, GridPosition B>
constexpr bool same_position(const A& a, const B& b) {
  return a.x == b.x && a.y == b.y;
}

/// Returns twice the signed area of abc; > 0 when counterclockwise.
template <GridPosition A, GridPosition B, GridPosition C>
constexpr std::int64_t doubled_area(const A& a, const B& b, const C& c) {
  const std::int64_t abx = std::int64_t{b.x} - a.x, aby = std::int64_t{b.y} - a.y;
  const std::int64_t acx = std::int64_t{c.x} - a.x, acy = std::int64_t{c.y} - a.y;
  return abx * acy - aby * acx;
}

/// Tells whether p lies ahead of an observer at `from` who faces `to`: within a right angle of that direction.
template <GridPosition A, GridPosition B, GridPosition P>
constexpr bool lies_ahead(const A& from, const B& to, const P& p) {
  return (std::int64_t{p.x} - from.x) * (std::int64_t{to.x} - from.x) +
             (std::int64_t{p.y} - from.y) * (std::int64_t{to.y} - from.y) >
         0;
}

/// Returns +1 for counterclockwise, 0 for collinear, -1 for clockwise positions.
template <GridPosition A, GridPosition B, GridPosition C>
constexpr int orientation(const A& a, const B& b, const C& c) {
  const std::int64_t area = doubled_area(a, b, c);
  return (area > 0) - (area < 0);
}

/// Returns +1 if d lies inside the circle through the counterclockwise a, b, c; 0 on it; -1 outside.
template <GridPosition P>
inline int in_circle(const P& a, const P& b, const P& c, const P& d) {
  const std::int64_t adx = std::int64_t{a.x} - d.x, ady = std::int64_t{a.y} - d.y;
  const std::int64_t bdx = std::int64_t{b.x} - d.x, bdy = std::int64_t{b.y} - d.y;
  const std::int64_t cdx = std::int64_t{c.x} - d.x, cdy = std::int64_t{c.y} - d.y;
  // These are exact in 64 bits: each is below 2^61.
  const std::int64_t bc = bdx * cdy - bdy * cdx, ca = cdx * ady - cdy * adx, ab = adx * bdy - ady * bdx;
  const std::int64_t a2 = adx * adx + ady * ady, b2 = bdx * bdx + bdy * bdy, c2 = cdx * cdx + cdy * cdy;

  const double ta = static_cast<double>(a2) * static_cast<double>(bc);
  const double tb = static_cast<double>(b2) * static_cast<double>(ca);
  const double tc = static_cast<double>(c2) * static_cast<double>(ab);
  const double det = ta + tb + tc;
  // The error of two conversions, a product and two sums is below 8 units of 2^-53 of the terms' sum.
  const double bound = 1e-15 * (std::abs(ta) + std::abs(tb) + std::abs(tc));
  if (det > bound) return 1;
  if (det < -bound) return -1;

  const Int128 exact = static_cast<Int128>(a2) * bc + static_cast<Int128>(b2) * ca + static_cast<Int128>(c2) * ab;
  return (exact > 0) - (exact < 0);
}

/// Applies the tie rule to in_circle(): never 0 for four different points, where a, b, c are counterclockwise.
template <GridPosition P>
inline int in_circle_perturbed(const P& a, const P& b, const P& c, const P& d) {
  if (const int side = in_circle(a, b, c, d); side != 0) return side;
  const auto less = [](const P* p, const P* q) { return p->x != q->x ? p->x < q->x : p->y < q->y; };
  std::array<const P*, 4> order{&a, &b, &c, &d};
  // Five compare-exchanges sort four.
  const auto exchange = [&](int i, int j) {
    if (less(order[j], order[i])) std::swap(order[i], order[j]);
  };
  exchange(0, 1), exchange(2, 3), exchange(0, 2), exchange(1, 3), exchange(1, 2);
  // The coefficient of the largest point's perturbation decides, unless it vanishes.
  for (int i = 3; i > 0; --i) {
    int sign = 0;
    if (order[i] == &d) return -1;
    if (order[i] == &c) sign = orientation(a, b, d);
    if (order[i] == &b) sign = orientation(a, d, c);
    if (order[i] == &a) sign = orientation(d, b, c);
    if (sign != 0) return sign;
  }
  return -1;
}

}  // namespace itin
