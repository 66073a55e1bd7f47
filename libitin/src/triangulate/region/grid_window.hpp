// A window on the integer grid, where membership is decided exactly.
//
//   GridWindow window(Window::disc({318000, 176000}, 5000), grid, index.bounds());
//   if (window.meets(a, b, c)) ...
//
// Corners are rounded to the nearest grid position. The region is every point about which the rings, outer ones
// counterclockwise and holes clockwise, wind at least once, and every point of a ring. It is closed, never empty, and
// defined also where rounding makes rings touch or cross. Where a ring leaves the grid, it is cut off one step outside
// it, which turns the edge that is cut by less than one grid step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <itin/bucket_lists.hpp>
#include <itin/geometry.hpp>
#include <itin/window.hpp>

#include "geometry/predicates.hpp"

namespace itin {

/// A window on the grid. Immutable; safe for concurrent use. A query about a small figure costs O(1) away from the
/// window's boundary, and O(edges nearby) at it, whatever the number of corners.
class GridWindow {
 public:
  /// Makes the region; Window::all() becomes the data bounds.
  GridWindow(const Window& window, const Grid& grid, const GridBox& data_bounds);

  /// Returns the part of the grid that the window may meet; empty for a window wholly outside the grid.
  const GridBox& bounds() const { return bounds_; }
  /// Tells whether the position is in the window, its boundary included.
  bool contains(std::int32_t x, std::int32_t y) const;
  /// Tells whether every position of the closed box is in the window, and the boundary does not meet the box.
  bool holds(const GridBox& box) const;
  /// Tells whether the window meets the closed box; touching counts.
  bool meets(const GridBox& box) const;
  /// Tells whether the window meets the closed triangle, of either orientation; touching counts.
  bool meets(const GridPoint& a, const GridPoint& b, const GridPoint& c) const;

 private:
  enum class State : std::uint8_t { Outside, Inside, Mixed };

  /// An edge of a ring, with the window's inside to its left.
  struct Edge {
    Position a;
    Position b;
    GridBox box() const;
  };

  /// A closed triangle or box, the shape that all queries share.
  class Figure;

  /// Closed ranges of cells.
  struct CellRange {
    std::uint32_t column0, column1, row0, row1;
    std::size_t count() const { return std::size_t{column1 - column0 + 1} * (row1 - row0 + 1); }
  };

  static std::vector<Position> corners_on(const Grid& grid, const Window::Ring& ring);
  void add_ring(std::vector<Position> corners, bool hole);
  static bool form_box(std::span<const Edge> edges);
  static std::vector<Edge> without_common_borders(const std::vector<Edge>& edges);
  bool is_box() const { return edges_.empty(); }
  void index_edges();
  void choose_cells();
  template <typename Visit>
  void visit_cells(const Edge& edge, const Visit& visit) const;
  void classify_cells();
  GridBox cell_box(std::uint32_t column, std::uint32_t row) const;
  CellRange cells(const GridBox& box) const;
  std::size_t cell(std::uint32_t column, std::uint32_t row) const { return std::size_t{row} * columns_ + column; }
  bool wound(std::int32_t x, std::int32_t y) const;
  bool boundary_meets(const Figure& figure, const CellRange& range) const;

  GridBox bounds_;           // within the grid
  GridBox extent_;           // the box about the edges; up to one step outside the grid
  std::vector<Edge> edges_;  // none: the window is the box extent_

  // A uniform grid of closed cells over extent_, with the edges that meet each cell, and each row of cells.
  int log2_cell_ = 0;
  std::uint32_t columns_ = 0;
  std::uint32_t rows_ = 0;
  std::vector<State> states_;
  BucketLists edges_by_cell_, edges_by_row_;
};

}  // namespace itin
