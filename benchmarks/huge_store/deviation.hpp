// How far the full surface lies from a coarser one, patch by patch, for one level after the other: over a patch,
// T_0 - T_k lies between the sums of the extremes of T_0 - T_1, T_1 - T_2, ..., T_(k-1) - T_k. Each of these is linear
// on the triangles of the finer of its two surfaces, so its extremes are found at the finer one's posts.
#pragma once

#include <cstddef>
#include <vector>

#include <itin/certificate.hpp>

#include "huge_store/posts.hpp"
#include "huge_store/square.hpp"
#include "store/cell.hpp"

namespace itin::huge {

class Deviation {
 public:
  /// Side of a patch; no cell asked for may be smaller.
  static constexpr int kPatchLog2Side = 13;

  explicit Deviation(const Square& square);

  /// Adds that of the surface of this stage from the one 2^steps times as coarse, over the cell. `heights`, in
  /// decimetres: of all posts about the cell, from one post of the coarser surface to another. Safe for concurrent use
  /// for different cells.
  void add(const Cell& cell, int stage, int steps, const Posts& heights);

  /// Of all that was added, over the ground in the cell; grid units.
  HeightBounds over(const Cell& cell) const;

 private:
  /// Calls visit(patch, its sum) for each patch that meets both the cell and the ground.
  template <class Deviations, class Visit>
  static void for_each_patch(Deviations& deviations, const Cell& cell, const Visit& visit);

  const Square& square_;
  std::int32_t first_column_, first_row_;
  std::size_t columns_;
  std::vector<HeightBounds> sums_;
};

}  // namespace itin::huge
