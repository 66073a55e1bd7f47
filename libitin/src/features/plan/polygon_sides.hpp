// Tells where positions lie relative to one polygon, or one area, however many corners it has.
//
//   const PolygonSides sides(polygon);
//   if (sides.at(p) == Side::inside) ...
//
// A grid of cells covers the polygon's box. Each cell knows the edges that meet it, and whether a reference place in it
// is inside. A look-up walks from the reference place, and crosses only edges of the cell. Everything is decided in
// integers.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <itin/bucket_lists.hpp>

#include "features/plan/plan_overlay.hpp"

namespace itin {

/// An index that does not need the polygon once made. It takes some 40 bytes per edge; a look-up takes time
/// proportional to the edges nearby. Safe for concurrent use.
class PolygonSides {
 public:
  explicit PolygonSides(const GridPolygon& polygon);
  /// The sides of the area that closed lines bound, by the even-odd rule.
  explicit PolygonSides(std::vector<GridEdge> edges);

  /// Tells the side as side_of() does.
  Side at(Position p) const;
  /// Whether the middle between two positions is inside. A middle on the border counts as what lies next to it to the
  /// right (and a little above).
  bool encloses_middle(Position a, Position b) const;
  /// Whether a place, to 2^-16 grid steps, is inside; on the border it counts as for encloses_middle().
  bool encloses(Point2 p) const;
  /// The pieces of the segment pq that lie inside, in order from p, computed in floating point.
  std::vector<std::pair<Point2, Point2>> inside_parts(Point2 p, Point2 q) const;

 private:
  /// A place in grid units times kScale, from the lower left corner of the box.
  struct Place {
    std::int64_t x, y;
  };
  static constexpr std::int64_t kScale = std::int64_t{1} << 16;

  Place place(Position p) const;
  std::int64_t reference(std::int64_t cell) const;
  bool in_box(const Place& p) const;
  std::size_t cell_of(const Place& p) const;
  void choose_cells(const GridBox& box);
  void fill_cells();
  void find_references();
  bool encloses(const Place& p) const;
  /// Calls visit(cell) for all cells that the segment meets, and perhaps some beside it.
  template <class Visit>
  void for_each_cell(Point2 p, Point2 q, const Visit& visit) const;

  std::vector<GridEdge> edges_;
  Position origin_;
  Place extent_{-1, -1};   ///< the upper right corner of the box
  std::int64_t side_ = 0;  ///< the side of a cell, in the units of Place
  std::int64_t columns_ = 0, rows_ = 0;
  BucketLists edges_of_cell_;
  std::vector<bool> inside_;  ///< by cell: whether the reference place is inside
};

}  // namespace itin
