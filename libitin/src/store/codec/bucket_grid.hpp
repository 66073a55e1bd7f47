// The buckets that a block's points fall into while their heights are predicted.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "store/codec/prediction_plane.hpp"

namespace itin {

/// A position within a block: on the block's lattice where there is one, else in grid units.
struct LocalPosition {
  std::uint32_t x, y;
};

/// Square buckets over the extent of some positions, at most two per position, with room for the neighbours of each.
class BucketGrid {
 public:
  /// Takes at least one position, and moves all to the corner of their extent.
  explicit BucketGrid(std::vector<LocalPosition>& positions) {
    const LocalPosition greatest = move_to_corner(positions);
    const auto buckets = [&](int shift) {
      return (std::uint64_t{greatest.x >> shift} + 1) * (std::uint64_t{greatest.y >> shift} + 1);
    };
    while (buckets(shift_) > 2 * positions.size()) ++shift_;
    stride_ = (greatest.x >> shift_) + 1 + 2 * kMargin;
    count_ = stride_ * ((greatest.y >> shift_) + 1 + 2 * kMargin);
    for (std::size_t i = 0; i < around_.size(); ++i)
      around_[i] = kBucketsAround[i].y * static_cast<std::ptrdiff_t>(stride_) + kBucketsAround[i].x;
  }

  std::size_t count() const { return count_; }
  std::size_t at(const LocalPosition& p) const {
    return ((p.y >> shift_) + kMargin) * stride_ + (p.x >> shift_) + kMargin;
  }
  /// Returns the way from a bucket to the i-th of kBucketsAround.
  std::ptrdiff_t around(std::size_t i) const { return around_[i]; }
  /// Returns log2 of a bucket's side. Where it is 0, a bucket is a single position.
  int shift() const { return shift_; }

 private:
  static constexpr std::size_t kMargin = 2;

  static LocalPosition move_to_corner(std::vector<LocalPosition>& positions) {
    LocalPosition low = positions.front(), high = low;
    for (const LocalPosition& p : positions) {
      low.x = std::min(low.x, p.x), high.x = std::max(high.x, p.x);
      low.y = std::min(low.y, p.y), high.y = std::max(high.y, p.y);
    }
    for (LocalPosition& p : positions) p.x -= low.x, p.y -= low.y;
    return {high.x - low.x, high.y - low.y};
  }

  int shift_ = 0;
  std::size_t stride_ = 0, count_ = 0;
  std::array<std::ptrdiff_t, kBucketsAround.size()> around_{};
};

}  // namespace itin
