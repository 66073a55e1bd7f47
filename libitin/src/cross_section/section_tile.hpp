// A triangulated tile that lines are walked through.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <itin/bucket_lists.hpp>

#include "cross_section/section_walk.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

/// All ground triangles that meet a square. Immutable; safe for concurrent use.
class SectionTile {
 public:
  SectionTile(const GridBox& square, const RegionMesh& region);

  const GridBox& square() const { return square_; }
  std::size_t bytes() const;

  /// A triangle, and the corner of it that is not on the edge by which it was entered; the edge's left end is the next
  /// one.
  struct Stop {
    std::uint32_t triangle = kNoTriangle;
    std::uint32_t apex = 0;
  };

  /// Returns the triangle ahead of an edge that is crossed at `place`; kNoTriangle where this tile does not have it.
  Stop ahead(const CrossedEdge& edge, Position place) const;
  /// Goes from a triangle to the one across an edge: from the apex to the left (or right) end of the edge by which the
  /// triangle was entered. Returns kNoTriangle where this tile does not have it.
  Stop onwards(const Stop& from, bool keeps_left) const;
  const SectionVertex& apex(const Stop& at) const { return vertices_[faces_[at.triangle].corners[at.apex]]; }
  /// Returns triangles, among them all that meet a box within the square.
  std::vector<std::array<SectionVertex, 3>> around(const GridBox& box) const;

 private:
  struct Face {
    std::array<std::uint32_t, 3> corners;
    std::array<std::uint32_t, 3> neighbours;  ///< opposite the corners
  };

  const SectionVertex& corner(std::uint32_t triangle, std::size_t i) const {
    return vertices_[faces_[triangle].corners[i]];
  }
  std::uint32_t column(std::int32_t x) const;
  std::uint32_t row(std::int32_t y) const;
  template <typename Visit>
  void for_each_bin(const GridBox& box, const Visit& visit) const;
  GridBox box_of(std::uint32_t triangle) const;

  GridBox square_;
  std::vector<SectionVertex> vertices_;
  std::vector<Face> faces_;  ///< in about the vertices' order, which is the Morton curve's: neighbours are near in
                             ///< memory
  // The following members list triangles by the bins of the square that their boxes meet.
  int bin_shift_ = 0;
  std::uint32_t columns_ = 0;
  std::uint32_t rows_ = 0;
  BucketLists bins_;  ///< numbers of faces
};

}  // namespace itin
