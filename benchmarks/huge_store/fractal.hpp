// A fractal surface by nested midpoint displacement. Any part of it can be computed by itself: it depends on the seed
// and on the posts' places alone.
//
// Stage k has the posts whose columns and rows are multiples of 2^k. Posts of stage kTopStage have random heights. A
// post that is new at a finer stage lies amid an edge of the next coarser stage. Its height is the mean of the heights
// of the edge's ends, rounded to a decimetre, plus a displacement of at most amplitude(k).
#pragma once

#include <cstdint>

#include "huge_store/posts.hpp"

namespace itin::huge {

class Fractal {
 public:
  static constexpr int kTopStage = 13;

  explicit Fractal(std::uint64_t seed) : seed_(seed) {}

  /// The greatest displacement, decimetres: 1 for stage 0, then 2^0.85 times as much per stage.
  static std::int32_t amplitude(int stage);
  /// The greatest distance, decimetres, between the surface and the one of this stage's posts alone.
  static double greatest_deviation(int stage);

  /// The heights of all posts of the box, in decimetres, and perhaps of some about it. Columns and rows are the
  /// stage's own, at least 0. Cost: 2 ns per post.
  Posts heights(int stage, const PostBox& box) const;

 private:
  std::uint64_t row_key(int stage, std::int32_t row) const;

  std::uint64_t seed_;
};

}  // namespace itin::huge
