// Finds items whose boxes meet a box, among many small ones.
//
//   const BoxIndex near(std::move(boxes));
//   near.for_each(box, [&](std::uint32_t item) { ... });
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <itin/bucket_lists.hpp>
#include <itin/geometry.hpp>

namespace itin {

/// Square buckets over the boxes' extent, at most two for each box.
class BoxIndex {
 public:
  BoxIndex() = default;
  explicit BoxIndex(std::vector<GridBox> boxes) : boxes_(std::move(boxes)) {
    if (boxes_.empty()) return;
    for (const GridBox& box : boxes_) extent_.extend(box);
    while (columns() * rows() > 2 * boxes_.size()) ++shift_;
    lists_ = BucketLists(columns() * rows(), boxes_.size(), [&](std::uint32_t item, const auto& add) {
      for_each_bucket(boxes_[item], [&](std::size_t column, std::size_t row) { add(row * columns() + column); });
    });
  }

  /// Calls visit(item) once for each item whose box meets `box`.
  template <class Visit>
  void for_each(const GridBox& box, const Visit& visit) const {
    const GridBox within = intersection(box, extent_);
    if (within.empty()) return;
    for_each_bucket(within, [&](std::size_t column, std::size_t row) {
      for (const std::uint32_t item : lists_.in(row * columns() + column)) {
        // An item counts in the first bucket that it shares with the box.
        const GridBox both = intersection(boxes_[item], within);
        if (!both.empty() && column_of(both.xmin) == column && row_of(both.ymin) == row) visit(item);
      }
    });
  }

 private:
  std::size_t column_of(std::int32_t x) const {
    return static_cast<std::size_t>((std::int64_t{x} - extent_.xmin) >> shift_);
  }
  std::size_t row_of(std::int32_t y) const {
    return static_cast<std::size_t>((std::int64_t{y} - extent_.ymin) >> shift_);
  }
  std::size_t columns() const { return column_of(extent_.xmax) + 1; }
  std::size_t rows() const { return row_of(extent_.ymax) + 1; }
  template <class Visit>
  void for_each_bucket(const GridBox& box, const Visit& visit) const {
    for (std::size_t row = row_of(box.ymin); row <= row_of(box.ymax); ++row)
      for (std::size_t column = column_of(box.xmin); column <= column_of(box.xmax); ++column) visit(column, row);
  }

  std::vector<GridBox> boxes_;
  GridBox extent_;
  int shift_ = 0;
  BucketLists lists_;
};

}  // namespace itin
