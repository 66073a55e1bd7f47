// The posts of a rectangular piece of a lattice, and the cells of it that stand alone.
//
//   LatticeSheet sheet(first, columns, rows);
//   sheet.add(leaf, block, selection);            // whatever meets sheet.box()
//   sheet.add(segment);
//   if (sheet.has(cell) && sheet.stands_alone(cell)) ... sheet.post(cell.x, cell.y)
//
// The circle about a square cell has no other place of the lattice in or on it. Suppose that a cell has all four posts,
// no other vertex lies in its circle and no segment touches it. Then it is ground, and its triangles are those on
// either side of the diagonal from lower right to upper left, as the tie rule of predicates.hpp has it.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include <itin/geometry.hpp>

#include "store/codec/point_index.hpp"
#include "triangulate/apex/selection.hpp"

namespace itin {

/// Four neighbouring places of a lattice, grid units.
struct LatticeCell {
  std::int64_t x = 0, y = 0;  ///< the lower left place
  std::int64_t side = 0;

  /// Returns a box beyond which nothing disturbs the cell.
  GridBox box_of_circle() const;
  friend auto operator<=>(const LatticeCell&, const LatticeCell&) = default;
};

class LatticeSheet {
 public:
  /// Makes a sheet without cells.
  LatticeSheet() = default;
  /// Makes a sheet without posts yet. `first` is its lower left cell. Precondition: each side is below 2^31 grid units.
  LatticeSheet(const LatticeCell& first, std::int64_t columns, std::int64_t rows);

  bool has_cells() const { return columns_ > 0; }
  const LatticeCell& first() const { return first_; }
  /// Returns a box beyond which nothing disturbs any cell.
  const GridBox& box() const { return box_; }
  /// Tells whether this is a cell of the sheet.
  bool has(const LatticeCell& cell) const;

  void add(const Leaf& leaf, const Block& block, const Selection& selection);
  void add(const Segment& segment);

  /// Tells whether the cell has all its posts and nothing disturbs it. Preconditions: has(cell), and everything that
  /// meets its box_of_circle() was added.
  bool stands_alone(const LatticeCell& cell) const;
  /// Returns a post. Precondition: one of its cells stands alone.
  GridPoint post(std::int64_t x, std::int64_t y) const;

  std::size_t posts() const { return posts_; }
  std::size_t bytes() const { return sizeof(*this) + heights_.capacity() * 4 + disturbed_.capacity() / 8; }

 private:
  std::size_t place(std::int64_t x, std::int64_t y) const;
  void disturb(const GridBox& box);

  LatticeCell first_;
  std::int64_t columns_ = 0, rows_ = 0;  ///< numbers of cells; there is one post more
  GridBox box_;
  std::vector<std::int32_t> heights_;  ///< by post, row by row from the south; kNoPost where there is none
  std::vector<bool> disturbed_;        ///< by cell, numbered by its lower left post
  std::size_t posts_ = 0;              ///< number of posts
};

/// Adds the selected segments about a sheet.
void add_segments(LatticeSheet& sheet, const PointIndex& index, const Selection& selection);

/// Returns any cell of the lattice that most points in a box seem to lie on; nothing where there are
/// no leaves.
std::optional<LatticeCell> cell_about(const GridBox& box, const PointIndex& index, const Selection& selection);

}  // namespace itin
