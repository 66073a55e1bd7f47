// The full surface about a box where it is a lattice of posts without gaps. Its triangles are known, and none of them
// has to be made.
//
//   if (const auto posts = WholeLattice::about(index, box)) posts->height(column, row)
//
// Rasters are lattices, and each of their squares is two triangles (lattice_crossings.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "pyramid/difference/lattice_crossings.hpp"
#include "store/codec/point_index.hpp"

namespace itin {

class WholeLattice {
 public:
  /// Returns the lattice of all squares that meet the box; touching counts. Returns nothing where anything but these
  /// squares meets the box, or comes near enough to change them: gaps, other points, lines, or ground that ends
  /// elsewhere than all ground does. Returns nothing, too, where the fullest leaf at the box has fewer than two columns
  /// or rows.
  static std::optional<WholeLattice> about(const PointIndex& index, const GridBox& box);

  /// The number of posts each way, two at least. Columns and rows are counted from the lower left post.
  std::int32_t columns() const { return columns_; }
  std::int32_t rows() const { return rows_; }
  /// The height of a post in grid units.
  std::int32_t height(std::int32_t column, std::int32_t row) const { return heights_[post(column, row)]; }
  std::size_t post(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  GridBox bounds() const;
  std::pair<std::int32_t, std::int32_t> height_range() const { return range_; }

  using Place = LatticePlace;  ///< places beyond the outermost posts count as well
  Position position(Place place) const;
  /// The place at a position; nothing for a position off the lattice.
  std::optional<Place> place(Position p) const;
  /// The columns, or rows, of squares that meet an interval of eastings, or northings, in grid units: [first, second).
  std::pair<std::int32_t, std::int32_t> square_columns(std::int32_t from, std::int32_t to) const;
  std::pair<std::int32_t, std::int32_t> square_rows(std::int32_t from, std::int32_t to) const;

  /// The outermost squares meet the box, but perhaps not both of their triangles do. Tells whether the box meets the
  /// upper right triangle of the last square, and the lower left one of the first.
  bool last_triangle_meets() const { return last_meets_; }
  bool first_triangle_meets() const { return first_meets_; }

 private:
  WholeLattice() = default;
  bool find_steps(const PointIndex& index, const std::vector<Leaf>& leaves);
  bool find_extent(const GridBox& box, const GridBox& all);
  bool read(const PointIndex& index, const GridBox& near);
  bool is_crossed(const PointIndex& index, const GridBox& near, const GridBox& all) const;
  void find_corners(const GridBox& box);

  std::int64_t west_ = 0, south_ = 0;  ///< position of the first post, grid units
  std::int64_t step_x_ = 0, step_y_ = 0;
  std::int32_t columns_ = 0, rows_ = 0;
  std::vector<std::int32_t> heights_;  ///< by post
  std::pair<std::int32_t, std::int32_t> range_;
  bool first_meets_ = true, last_meets_ = true;
};

}  // namespace itin
