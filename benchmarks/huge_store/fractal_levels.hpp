// The levels of a fractal store: each has the posts of one stage, the coarsest that its tolerance allows.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/cell.hpp"
#include "huge_store/square.hpp"

namespace itin::huge {

struct FractalLevel {
  double tolerance = 0;  ///< metres
  int stage = 0;
  /// The next level's surface is 2^steps times as coarse; 0 for the last level.
  int steps = 0;

  /// Whether a post of the stage belongs to no coarser level.
  bool keeps(std::int32_t column, std::int32_t row) const {
    return steps == 0 || ((column | row) & ((1 << steps) - 1)) != 0;
  }
  std::int64_t count(const PostBox& box) const { return box.count() - (steps == 0 ? 0 : box.count_of_every(steps)); }
};

/// Returns the levels of tolerances, which ascend, in metres, 0 first. Tolerances that no stage of their own meets are
/// left out.
std::vector<FractalLevel> levels_of(const std::vector<double>& tolerances);

/// Calls visit(cell) along the curve for each cell over the ground in `from` that is a leaf of the level's quadtree if
/// leaves hold up to `capacity` posts: posts decide alone.
template <class Visit>
void for_each_leaf(const FractalLevel& level, const Square& square, const Cell& from, std::int64_t capacity,
                   const Visit& visit) {
  if (!square.meets(from)) return;
  if (level.count(square.within(from, level.stage)) <= capacity) {
    visit(from);
    return;
  }
  for (int i = 0; i < 4; ++i) for_each_leaf(level, square, from.child(i), capacity, visit);
}

}  // namespace itin::huge
