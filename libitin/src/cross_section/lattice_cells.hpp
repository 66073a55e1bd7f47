// Triangles along a line over a lattice of posts, told by where they are and not by a search.
//
//   LatticeCells cells(index, selection, heading);
//   if (const auto c = cells.beyond(a, b)) ...           // abc is a triangle of the global triangulation
//
// The circle about a square cell has no other place of the lattice in or on it. So where a cell has all four posts,
// nothing else stands in its circle and no segment touches it, it is ground, and its triangles are those on either side
// of the diagonal from lower right to upper left, as the tie rule of predicates.hpp has it.
//
// Posts are kept for a sheet of the lattice about the line, and are read where a cell asks for them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <itin/geometry.hpp>

#include "geometry/predicates.hpp"
#include "store/point_index.hpp"
#include "triangulate/read_once.hpp"
#include "triangulate/selection.hpp"

namespace itin {

/// Serves one thread and one line. Does not know everything: what it says nothing of has to be searched for.
class LatticeCells {
 public:
  /// Edges will come one after another in about the direction `heading`.
  LatticeCells(const ReadOnce& index, const Selection& selection, Point2 heading);

  /// The third vertex of the triangle to the left of ab, where it is half a cell.
  std::optional<GridPoint> beyond(Position a, Position b);
  /// The triangles of all cells that meet a box, counterclockwise; none unless all that is there are cells.
  std::vector<std::array<GridPoint, 3>> around(const GridBox& box);

 private:
  /// A cell by its lower left corner.
  struct Corner {
    std::int64_t x = 0, y = 0;
  };
  struct Unread {
    Leaf leaf;
    GridBox box;  ///< its cell's
  };

  bool known(const Corner& cell, std::int64_t spacing);
  bool on_sheet(const Corner& cell, std::int64_t spacing) const;
  bool lay(const Corner& cell, std::int64_t spacing);
  void load(const Leaf& leaf);
  std::size_t post(std::int64_t x, std::int64_t y) const;
  GridPoint point(std::int64_t x, std::int64_t y) const;

  const ReadOnce& index_;
  const Selection& selection_;
  Point2 heading_;

  std::int64_t spacing_ = 0;           ///< from post to post of the sheet, grid units; 0 before the first sheet
  Corner first_;                       ///< the sheet's lower left post
  GridBox box_;                        ///< what is read for it
  std::vector<Unread> unread_;         ///< leaves in box_ that are still to be read
  std::vector<std::int32_t> heights_;  ///< one for each post of the sheet, row by row from the south
  std::vector<Position> odd_;          ///< what is there besides
  std::vector<GridBox> segments_;      ///< the boxes of its segments
  std::vector<Leaf> leaves_;           ///< kept to reuse their memory
  std::vector<Segment> edges_;
  std::uint64_t sheets_ = 0, cells_ = 0;  ///< laid, and known by them
};

}  // namespace itin
