// Verification of the pyramid against law 2, and the certificates that come of it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <itin/progress.hpp>

#include "pyramid/overlay.hpp"
#include "pyramid/working_index.hpp"

namespace itin {

/// The bounds of every level in every leaf of the working index: T_k + lo <= T_0 <= T_k + hi over the leaf.
class LeafBounds {
 public:
  LeafBounds(std::size_t leaves, int levels) : levels_(levels), bounds_(leaves * static_cast<std::size_t>(levels)) {}
  DifferenceRange& at(std::uint32_t leaf, int level) { return bounds_[std::size_t{leaf} * levels_ + level]; }
  const DifferenceRange& at(std::uint32_t leaf, int level) const {
    return bounds_[std::size_t{leaf} * levels_ + level];
  }

 private:
  int levels_;
  std::vector<DifferenceRange> bounds_;
};

struct FailedPlace {
  GridBox box;
  int level;
};
/// Returns whether it changed any line.
using RestoreLines = std::function<bool(const std::vector<FailedPlace>&)>;

/// Raises levels in the index until |T_0 - T_k| <= tolerances[k] everywhere, for each k >= 1, and returns the bounds by
/// leaf. `tolerances` in whole grid units, level 0 first. Leaves without ground keep empty bounds.
///
/// In rounds. The first one measures everything, against real windows of the whole. In the later ones each cell that
/// fails raises its own points until its part holds while its neighbours stay as they were; cells near which a
/// neighbour raised something are verified again. So the outcome depends on the points alone, not on threads.
///
/// Where a level lacks no vertex any more and still fails, its lines differ from the full surface's: `restore` is
/// called with these places, puts lines back, and it starts again. Without lines there are no such places. Throws Error
/// where restore has nothing to put back.
LeafBounds certify(WorkingIndex& index, const std::vector<std::int32_t>& tolerances, const RestoreLines& restore,
                   Progress& progress);

}  // namespace itin
