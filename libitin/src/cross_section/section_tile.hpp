// A triangulated tile that lines are walked through.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cross_section/section_walk.hpp"
#include "triangulate/region.hpp"

namespace itin {

/// All ground triangles that meet a square. Immutable; safe for concurrent use.
class SectionTile {
 public:
  SectionTile(const GridBox& square, RegionMesh region);

  const GridBox& square() const { return square_; }
  std::size_t bytes() const;

  /// The triangle ahead of an edge that is crossed at `place`; kNoTriangle where this tile does not have it.
  std::uint32_t triangle_ahead(const CrossedEdge& edge, Position place) const;
  /// The triangle beyond an edge of `triangle`; kNoTriangle where this tile does not have it.
  std::uint32_t neighbour(std::uint32_t triangle, const CrossedEdge& edge) const;
  /// The corner of `triangle` that is not on its edge.
  const GridPoint& apex(std::uint32_t triangle, const CrossedEdge& edge) const;
  /// Triangles, among them all that meet a box within the square.
  std::vector<std::array<GridPoint, 3>> around(const GridBox& box) const;

 private:
  const GridPoint& corner(std::uint32_t triangle, std::size_t i) const {
    return region_.vertices[region_.mesh.triangles[triangle][i]].point;
  }
  std::size_t corner_off(std::uint32_t triangle, const CrossedEdge& edge) const;
  std::uint32_t column(std::int32_t x) const;
  std::uint32_t row(std::int32_t y) const;
  template <typename Visit>
  void for_each_bin(const GridBox& box, const Visit& visit) const;
  GridBox box_of(std::uint32_t triangle) const;
  std::span<const std::uint32_t> in_bin(std::size_t bin) const;

  GridBox square_;
  RegionMesh region_;
  // Triangles by the bins of the square that their boxes meet.
  int bin_shift_ = 0;
  std::uint32_t columns_ = 0;
  std::uint32_t rows_ = 0;
  std::vector<std::uint32_t> first_;  ///< per bin, into triangles_
  std::vector<std::uint32_t> triangles_;
};

}  // namespace itin
