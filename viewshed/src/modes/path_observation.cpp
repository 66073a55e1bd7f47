#include "modes/path_observation.hpp"

namespace itin::viewshed {

std::uint64_t PathObservation::observe(const TileView& tile) {
  const std::uint64_t lines = Observation::observe(tile);
  scratch_ = {};
  return lines;
}

void PathObservation::study(const TileView& tile, const CellView& view, const Sight& sight) {
  if (sight.verdict == Verdict::kUndecided) {
    unknown_.set(view.cell);
    return;
  }
  const LineLosses::Outcome outcome = tile.studies->losses->of_line({sight.from, sight.to}, scratch_);
  if (outcome.over_missing && nodata_ == NoData::kUnknown) unknown_.set(view.cell);
  if (!outcome.loss || (outcome.over_missing && nodata_ != NoData::kClear)) return;
  take(view.cell, *outcome.loss);
}

}  // namespace itin::viewshed
