// The posts of a lattice, laid out for rays that leave many observers at once: the observers of a row stand `step`
// posts apart, and what lies at one place from each of them lies side by side.
//
//   const PostRows posts(lattice, box, first, 2);
//   const std::ptrdiff_t here = posts.place(observer, row);
//   posts.heights()[here + posts.offset(3, -1)];       // the post 3 columns east and 1 row north of this observer's
//   posts.heights()[here + posts.offset(3, -1) + 1];   // the post that lies so from the next observer of the row
//
// Columns and rows are the lattice's; they may lie beyond it, where there is no ground.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <itin/lattice_tin.hpp>

namespace itin::viewshed {

/// The places of a lattice from a first to a last column and row, all included.
struct PostBox {
  std::int64_t west = 0, north = 0, east = -1, south = -1;

  /// Grows by another box.
  void extend(const PostBox& other) {
    west = std::min(west, other.west), north = std::min(north, other.north);
    east = std::max(east, other.east), south = std::max(south, other.south);
  }
  /// Returns all places that lie from a place of this box as places of the other lie from (0, 0).
  PostBox around(const PostBox& other) const {
    return {west + other.west, north + other.north, east + other.east, south + other.south};
  }
  std::int64_t columns() const { return east - west + 1; }
  std::int64_t rows() const { return south - north + 1; }
  std::uint64_t count() const { return static_cast<std::uint64_t>(columns() * rows()); }
};

/// A triangle as a plane over its cell.
struct HalfPlane {
  double north_west = 0;  ///< height at the cell's north-western post, grid units
  double east = 0;        ///< what it gains over the cell's width
  double south = 0;

  double at(double u, double v) const { return north_west + u * east + v * south; }
};

class PostRows {
 public:
  /// How many observers are looked from at once. As many places may be read from a place on, whoever stands there.
  static constexpr std::size_t kTogether = 16;

  /// Copies the posts of a box. Observer 0 of every row stands in column `first`, or up to a post further east.
  /// Precondition: the lattice's heights have been read there.
  PostRows(const LatticeTin& lattice, const PostBox& box, std::int64_t first, std::int64_t step);

  std::ptrdiff_t place(std::int64_t observer, std::int64_t row) const {
    return (row - box_.north) * row_length_ + observer - first_quotient_;
  }
  /// Returns how far a post that lies so far to the east and the south of an observer's comes after it in the list.
  std::ptrdiff_t offset(std::int64_t columns, std::int64_t rows) const {
    const std::int64_t quotient = quotient_of(columns);
    return rows * row_length_ + (columns - quotient * step_) * class_length_ + quotient;
  }
  const std::int32_t* heights() const { return heights_.data(); }
  /// Returns the halves of each cell, as bits of LatticeTin::Half, at its north-western post; null where all are whole.
  const std::uint8_t* halves() const { return halves_.empty() ? nullptr : halves_.data(); }
  std::uint64_t triangle_count() const;
  /// Returns a height, grid units, that no post of a box exceeds.
  std::int32_t highest(const PostBox& box) const;
  /// Tells whether all cells between the posts of a box are whole.
  bool whole(const PostBox& box) const;

  /// Returns the height of the ground, grid units, at the place (u, v) east and south of an observer's post, in cells,
  /// both in [0, 1); nothing where there is no ground.
  std::optional<double> ground(std::ptrdiff_t place, double u, double v) const;
  /// Returns a half of the cell that lies so far to the east and the south of an observer's. Precondition: its three
  /// posts are there.
  HalfPlane plane(std::ptrdiff_t place, std::int64_t columns, std::int64_t rows, LatticeTin::Half half) const;

 private:
  std::int64_t quotient_of(std::int64_t columns) const {
    return columns >= 0 ? columns / step_ : -((step_ - 1 - columns) / step_);
  }
  void copy_row(const LatticeTin& lattice, std::int64_t row);
  void find_highest(std::int64_t block_row);

  PostBox box_;
  std::int64_t first_, step_;
  std::int64_t first_quotient_;  ///< the least quotient of a column's distance from the first observer by the step
  std::int64_t class_length_;    ///< posts of a row whose distances from the first observer leave the same remainder
  std::int64_t row_length_;
  std::vector<std::int32_t> heights_;
  std::vector<std::uint8_t> halves_;
  std::int64_t block_columns_;
  std::vector<std::int32_t> highest_;  ///< the greatest heights of square blocks of posts

  std::int64_t tile_columns_;
  std::vector<bool> whole_;  ///< one for each tile of the lattice
};

}  // namespace itin::viewshed
