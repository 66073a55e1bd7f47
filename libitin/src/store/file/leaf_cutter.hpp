// Cuts a stream of ascending Morton codes into the leaves of a bucket quadtree (PR quadtree): the largest cells that
// hold no more than a given number of points. The tree depends on the set of codes alone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <utility>

#include <itin/precondition.hpp>

#include "geometry/cell.hpp"

namespace itin {

/// Calls emit(Cell, count) in Morton order; together the cells tile the root. Precondition: no cell of side 1 has more
/// than `capacity` distinct codes, that is, capacity >= 1 and codes are distinct.
template <class Emit>
class LeafCutter {
 public:
  LeafCutter(std::uint32_t capacity, Emit emit) : capacity_(capacity), emit_(std::move(emit)) {}

  void add(std::uint64_t code) {
    ITIN_PRECONDITION(capacity_ >= 1 && (pending_.empty() || pending_.back() < code));
    pending_.push_back(code);
    while (pending_.size() > capacity_) cut();
  }

  void finish() {
    while (next_ < kRootEnd) cut();
  }

 private:
  static constexpr std::uint64_t kRootEnd = std::uint64_t{1} << (2 * kRootLog2Side);

  /// Emits the largest aligned cell at next_ that is not too full. Its parent is too full, or began earlier and was
  /// found too full then.
  void cut() {
    Cell cell{next_, 0};
    while (cell.log2_side < kRootLog2Side) {
      const Cell larger = cell.parent();
      if (larger.code != next_ || too_full(larger)) break;
      cell = larger;
    }
    const auto inside = std::lower_bound(pending_.begin(), pending_.end(), cell.end());
    const auto count = static_cast<std::uint32_t>(inside - pending_.begin());
    emit_(cell, count);
    pending_.erase(pending_.begin(), inside);
    next_ = cell.end();
  }

  bool too_full(const Cell& cell) const { return pending_.size() > capacity_ && pending_[capacity_] < cell.end(); }

  std::uint32_t capacity_;
  Emit emit_;
  std::deque<std::uint64_t> pending_;
  std::uint64_t next_ = 0;
};

}  // namespace itin
