// Cells judged block by block, by bounds of how low and how high the surface is. A block that the ground before it
// certainly hides is hidden, even a whole tile; all else stays undecided, except for what is known exactly near the
// eye. No line is cast, so that this takes a few nanoseconds per cell. Features may stand on the surface: they hide
// more, never less.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "judge/bounded_envelope.hpp"
#include "judge/tile_judge.hpp"
#include "request/void_shadow.hpp"
#include "scene/sweep/horizon_view.hpp"

namespace itin::viewshed {

/// Verdicts on the cells about the eye that are known exactly, row by row; Verdict::kOutside where nothing is known.
struct ExactNearby {
  RasterGrid::Cell first;
  std::int64_t columns = 0, rows = 0;
  std::vector<Verdict> verdicts;

  Verdict at(RasterGrid::Cell place) const {
    const std::int64_t column = place.column - first.column, row = place.row - first.row;
    if (column < 0 || row < 0 || column >= columns || row >= rows) return Verdict::kOutside;
    return verdicts[static_cast<std::size_t>(row * columns + column)];
  }
};

class BlockJudge final : public TileJudge {
 public:
  /// `tiles` are the tiles of `grid`; `nearby` may be null. All must outlive this object.
  BlockJudge(const BoundedEnvelope& surface, const Request& request, const RasterGrid& grid, const RasterGrid& tiles,
             const Eye& eye, const ExactNearby* nearby);

  /// Returns false where neither the ground in a box, metres, nor any target on it is seen.
  bool may_see(const Box& ground) const;

  std::unique_ptr<Work> begin(std::size_t tile) const override;
  const Eye& eye(std::size_t) const override { return eye_; }

 private:
  class BlockWork;

  const BoundedEnvelope& surface_;
  const RasterGrid& grid_;
  const RasterGrid& tiles_;
  const Eye& eye_;
  const ExactNearby* nearby_;
  HorizonView horizon_;
  std::optional<VoidShadow> shadow_;  ///< where ground without data hides
};

}  // namespace itin::viewshed
