// The difference between a full surface that is a whole lattice and a coarse one (overlay.hpp), without the lattice's
// triangles.
//
//   LatticeDifference difference(*WholeLattice::about(index, box));
//   if (difference.compare(coarse)) difference.over(square)        // T_0 - T_k there
//
// The posts within a coarse triangle are gone through row by row, and the lattice's lines that a coarse edge crosses
// one by one.
#pragma once

#include <limits>
#include <vector>

#include "pyramid/overlay.hpp"
#include "pyramid/whole_lattice.hpp"

namespace itin {

class LatticeDifference {
 public:
  explicit LatticeDifference(WholeLattice posts);

  const WholeLattice& posts() const { return posts_; }

  /// Measures the difference to this surface, which must cover the lattice. False where that takes triangles: where
  /// vertices of the coarse surface are no posts, or numbers become too large.
  bool compare(const RegionMesh& coarse);

  /// What difference() and over_triangles() say of those of the triangles about the lattice's box whose own boxes meet
  /// the square, but for rounding in the last places of crossings. After compare().
  DifferenceRange over(const GridBox& square) const;
  /// Over all these triangles.
  DifferenceRange whole() const { return over(posts_.bounds()); }

 private:
  /// A vertex of the coarse surface.
  struct Corner {
    std::int64_t column, row, z;
  };
  struct Range {
    double lo = std::numeric_limits<double>::infinity(), hi = -std::numeric_limits<double>::infinity();
    void add(double difference) {
      if (difference < lo) lo = difference;
      if (difference > hi) hi = difference;
    }
  };

  bool place(const RegionMesh& coarse);
  bool fits(const RegionMesh& coarse) const;
  void compare_posts(const Corner& a, const Corner& b, const Corner& c);
  void cross_lines(const Corner& a, const Corner& b);
  template <class EdgeAt>
  void cross_family(std::int64_t from, std::int64_t to, std::int64_t start, std::int64_t end, std::int64_t least,
                    std::int64_t greatest, double from_z, double to_z, const EdgeAt& edge_at);
  void leave_out_corners();

  std::int32_t height(std::int64_t column, std::int64_t row) const {
    return posts_.height(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
  }
  std::size_t post(std::int64_t column, std::int64_t row) const {
    return posts_.post(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
  }

  WholeLattice posts_;
  std::vector<Corner> corners_;
  std::vector<double> at_post_;  ///< not a number where it does not count
  /// Where coarse edges cross the sides of a square's lower left triangle, and of its upper right one: by the square's
  /// lower left post.
  std::vector<Range> lower_left_, upper_right_;
};

}  // namespace itin
