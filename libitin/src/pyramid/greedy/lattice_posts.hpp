// Points that are posts of a lattice, perhaps with gaps, by column and row.
//
//   if (const auto posts = LatticePosts::of(vertices)) vertices[posts->vertex({column, row})]
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pyramid/difference/lattice_crossings.hpp"
#include "triangulate/apex/apex.hpp"

namespace itin {

/// Stands in place of a vertex's number where there is no vertex.
inline constexpr std::uint32_t kNoVertex = 0xffffffff;

class LatticePosts {
 public:
  /// Returns nothing where most of the vertices have no neighbours on the finest lattice that holds them all.
  static std::optional<LatticePosts> of(std::span<const SelectedVertex> vertices);

  std::int64_t columns() const { return columns_; }
  std::int64_t rows() const { return rows_; }
  /// The steps in grid units.
  std::int64_t step_x() const { return step_x_; }
  std::int64_t step_y() const { return step_y_; }

  /// The place of a post with the position `p`, which is anything with x and y.
  template <class Point>
  LatticePlace place_of(const Point& p) const {
    // A multiplication is quicker than a division. The factors are a little too great, so that none is rounded down.
    const double east = static_cast<double>(p.x) - west_, north = static_cast<double>(p.y) - south_;
    return {static_cast<std::int64_t>(east * columns_per_unit_), static_cast<std::int64_t>(north * rows_per_unit_)};
  }
  /// The index of a place among all places, by row and then by column.
  std::size_t index(std::int64_t column, std::int64_t row) const {
    return static_cast<std::size_t>(row * columns_ + column);
  }
  std::size_t places() const { return index(0, rows_); }
  std::uint32_t vertex_at(std::size_t index) const { return vertices_[index]; }
  /// The vertex at a place; kNoVertex where there is none, and beyond the lattice.
  std::uint32_t vertex(const LatticePlace& place) const {
    const bool inside = place.column >= 0 && place.column < columns_ && place.row >= 0 && place.row < rows_;
    return inside ? vertices_[index(place.column, place.row)] : kNoVertex;
  }
  bool has(std::int64_t column, std::int64_t row) const { return vertex({column, row}) != kNoVertex; }

 private:
  LatticePosts() = default;
  bool find_lattice(std::span<const SelectedVertex> vertices);
  void place(std::span<const SelectedVertex> vertices);
  std::size_t count_with_neighbours() const;

  std::int64_t columns_ = 0, rows_ = 0, step_x_ = 1, step_y_ = 1;
  std::int32_t west_ = 0, south_ = 0;  ///< where the first place is, grid units
  double columns_per_unit_ = 0, rows_per_unit_ = 0;
  std::vector<std::uint32_t> vertices_;  ///< by place
};

}  // namespace itin
