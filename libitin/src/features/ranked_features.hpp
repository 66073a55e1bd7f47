// Which of several features of a theme that touch each other a vertex of the surface is of, as the import decided it.
//
//   const RankedFeatures ranked(store, theme, {12, 13}, progress);
//   const std::int64_t house = ranked.owner(corner, {12, 13});
//
// Where two features meet, the wall stands in the lower one, and the party line is the other's
// (footprint_arrangement.hpp). A store does not say which is which, so that their ranks are found again: from their
// footprints and the ground beneath them, by prepare().
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "features/plan/mask_index.hpp"
#include "geometry/cell.hpp"

namespace itin {

/// Returns the boxes about a theme's features with these numbers, and what may belong to them beside their footprints.
/// Throws CorruptStore.
std::vector<Box> boxes_beside(const Store& store, std::uint16_t theme, const std::vector<std::int64_t>& numbers);

class RankedFeatures {
 public:
  /// Takes the numbers of features that may touch each other. Cost: triangulates the ground beneath them. Throws
  /// CorruptStore, Cancelled.
  RankedFeatures(const Store& store, std::uint16_t theme, const std::vector<std::int64_t>& numbers, Progress& progress);

  /// Returns which of these features a vertex is of that touches them. Among equals it is the first one. A raster of
  /// heights has no rank: everything else comes before it.
  std::int64_t owner(const Position& vertex, const std::vector<std::int64_t>& numbers) const;

 private:
  struct RankedPatch {
    MaskIndex plan;
    double rank = 0;
  };
  /// Returns the rank of the highest of a feature's patches that touch the position, or of its only one.
  double rank_at(const Position& p, std::int64_t number) const;

  std::map<std::int64_t, std::vector<RankedPatch>> patches_;  ///< by the feature's number
};

}  // namespace itin
