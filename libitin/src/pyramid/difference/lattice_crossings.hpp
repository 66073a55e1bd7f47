// Finds where a straight line from one post of a lattice to another crosses the sides of the lattice's triangles.
//
//   for_each_crossing(from, to, columns, rows, [](const LatticeSide& side, double part, double along) { ... });
//
// Places are counted from the lattice's lower left post, which is {0, 0}. A square between four posts is two triangles,
// on either side of the diagonal from lower right to upper left (triangulate/region/lattice_squares.hpp). Their sides
// lie on columns, on rows and on diagonals.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "geometry/post_lattice.hpp"
#include "geometry/whole_division.hpp"

namespace itin {

/// A side from post u to post v. It belongs to the lower left triangle of one square, and the upper right triangle of
/// another.
struct LatticeSide {
  LatticePlace u, v;
  LatticePlace lower_left, upper_right;  ///< the lower left posts of these squares
  LatticePlace left, right;              ///< the posts opposite the side in these triangles, in the same order
};

/// Calls visit(line, whole, part, along) for each whole line within [least, greatest] that lies strictly between `from`
/// and `to`, in ascending order. A way from `start` on line `from` to `end` on line `to` crosses the line at whole +
/// part, where 0 < part < 1, after the share `along` of its length. Lines that are crossed at a whole number are passed
/// over.
template <class Visit>
void cross_lines(std::int64_t from, std::int64_t to, std::int64_t start, std::int64_t end, std::int64_t least,
                 std::int64_t greatest, const Visit& visit) {
  const bool back = from > to;
  if (back) std::swap(from, to), std::swap(start, end);
  const std::int64_t first = std::max(from + 1, least), last = std::min(to - 1, greatest);
  if (first > last) return;
  const std::int64_t lines = to - from, across = end - start, step = floor_divide(across, lines),
                     rest_of_step = across - step * lines;
  const std::int64_t so_far = across * (first - from);
  std::int64_t whole = start + floor_divide(so_far, lines), rest = so_far - (whole - start) * lines;
  const double share = 1.0 / static_cast<double>(lines);
  for (std::int64_t line = first; line <= last; ++line) {
    const double along = static_cast<double>(line - from) * share;
    if (rest != 0) visit(line, whole, static_cast<double>(rest) * share, back ? 1 - along : along);
    whole += step, rest += rest_of_step;
    if (rest >= lines) ++whole, rest -= lines;
  }
}

/// Calls visit(side, part, along) for each side between two posts of a lattice of these columns and rows that the way
/// between these places crosses properly. It crosses at `part` of the side, after the share `along` of its own length.
/// Both are in (0, 1).
template <class Visit>
void for_each_crossing(const LatticePlace& from, const LatticePlace& to, std::int64_t columns, std::int64_t rows,
                       const Visit& visit) {
  cross_lines(from.column, to.column, from.row, to.row, 0, columns - 1,
              [&](std::int64_t c, std::int64_t r, double part, double along) {
                if (r < 0 || r >= rows - 1) return;
                visit(LatticeSide{{c, r}, {c, r + 1}, {c, r}, {c - 1, r}, {c + 1, r}, {c - 1, r + 1}}, part, along);
              });
  cross_lines(from.row, to.row, from.column, to.column, 0, rows - 1,
              [&](std::int64_t r, std::int64_t c, double part, double along) {
                if (c < 0 || c >= columns - 1) return;
                visit(LatticeSide{{c, r}, {c + 1, r}, {c, r}, {c, r - 1}, {c, r + 1}, {c + 1, r - 1}}, part, along);
              });
  // The column and row of a diagonal's posts have a constant sum.
  cross_lines(from.column + from.row, to.column + to.row, from.column, to.column, 1, columns + rows - 3,
              [&](std::int64_t sum, std::int64_t c, double part, double along) {
                const std::int64_t r = sum - c - 1;
                if (c < 0 || c >= columns - 1 || r < 0 || r >= rows - 1) return;
                visit(LatticeSide{{c, r + 1}, {c + 1, r}, {c, r}, {c, r}, {c, r}, {c + 1, r + 1}}, part, along);
              });
}

}  // namespace itin
