// The difference between a full surface that is a whole lattice and a coarse one (overlay.hpp), without the lattice's
// triangles.
//
//   LatticeDifference difference(*WholeLattice::about(index, box));
//   if (difference.compare(coarse, allowed)) difference.over(square)        // T_0 - T_k there
//
// The posts within a coarse triangle are visited row by row, and the lattice's lines that a coarse edge crosses one by
// one.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "pyramid/difference/overlay.hpp"
#include "pyramid/difference/whole_lattice.hpp"

namespace itin {

class LatticeDifference {
 public:
  explicit LatticeDifference(WholeLattice posts);

  const WholeLattice& posts() const { return posts_; }

  /// Measures the difference to this surface, which must cover the lattice. A difference greater than `allowed` is a
  /// failure. Returns false where triangles are needed for that: where vertices of the coarse surface are no posts, or
  /// numbers become too large.
  bool compare(const RegionMesh& coarse, std::int32_t allowed);

  /// Returns what difference() and over_triangles() tell about the triangles at the lattice's box whose own boxes meet
  /// the square, except for rounding in the last places of crossings. To be called after compare().
  DifferenceRange over(const GridBox& square) const;
  /// The failures that difference() would tell, except that a post on a coarse edge counts for both faces there.
  const Failures& failures() const { return failures_; }

 private:
  using Place = WholeLattice::Place;
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
  void compare_posts(const std::array<std::uint32_t, 3>& face);
  void compare_crossings(std::uint32_t from, std::uint32_t to);
  void note_failure(std::uint32_t from, std::uint32_t to, const LatticeSide& side, double above);
  bool is_left_out(Place post) const;
  bool is_square(Place lower_left) const;
  void leave_out_corners();

  std::int32_t height(std::int64_t column, std::int64_t row) const {
    return posts_.height(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
  }
  std::size_t post(std::int64_t column, std::int64_t row) const {
    return posts_.post(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
  }

  WholeLattice posts_;
  std::int32_t allowed_ = 0;
  Failures failures_;
  std::vector<Corner> corners_;
  std::vector<double> at_post_;  ///< by post; not a number where a post does not count
  /// The ranges where coarse edges cross the sides of a square's lower left triangle, and of its upper right one, by
  /// the square's lower left post.
  std::vector<Range> lower_left_, upper_right_;
};

}  // namespace itin
