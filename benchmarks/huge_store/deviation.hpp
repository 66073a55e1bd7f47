// How far the full surface lies from the surfaces of the coarser levels, patch by patch. T_0 - T_k is linear on the
// triangles of T_0, which divide those of T_k, so its extremes over a patch are found at the posts about it.
#pragma once

#include <cstddef>
#include <vector>

#include <itin/certificate.hpp>

#include "geometry/cell.hpp"
#include "huge_store/fractal.hpp"
#include "huge_store/fractal_levels.hpp"
#include "huge_store/posts.hpp"
#include "huge_store/square.hpp"

namespace itin::huge {

class Deviation {
 public:
  /// Side of a patch; no cell asked for may be smaller.
  static constexpr int kPatchLog2Side = 13;

  Deviation(const Square& square, const Fractal& fractal, const std::vector<FractalLevel>& levels);

  /// Finds the deviations of all levels over the cell; `heights` has the heights of the full surface's posts about it,
  /// in decimetres. Safe for concurrent use for different cells. About 2 ns per post and level.
  void find(const Cell& cell, const Posts& heights);

  /// Returns bounds with T_k + lo <= T_0 <= T_k + hi over the ground in the cell, k being the level; grid units.
  /// Precondition: find() was called there.
  HeightBounds over(const Cell& cell, int level) const;

 private:
  /// Calls visit(patch, its number) for each patch that meets both the cell and the ground.
  template <class Visit>
  void for_each_patch(const Cell& cell, const Visit& visit) const;

  const Square& square_;
  const Fractal& fractal_;
  const std::vector<FractalLevel>& levels_;
  std::int32_t first_column_, first_row_;
  std::size_t columns_;
  std::vector<std::vector<HeightBounds>> bounds_;  ///< by level, by patch
};

}  // namespace itin::huge
