#include "modes/probability_observation.hpp"

#include <algorithm>
#include <limits>

namespace itin::viewshed {

ProbabilityObservation::ProbabilityObservation(NoData nodata) : nodata_(nodata) {
  probabilities_.fill(0);
}

std::uint64_t ProbabilityObservation::observe(const TileView& tile) {
  scratch_.emplace(*tile.studies->odds);
  const std::uint64_t lines = Observation::observe(tile);
  scratch_.reset();
  return lines;
}

/// At the eye itself, where nothing can come between.
void ProbabilityObservation::keep(const CellView& view) {
  probabilities_[view.cell] = 1;
}

void ProbabilityObservation::study(const TileView& tile, const CellView& view, const Sight& sight) {
  const VisibilityProbability::Odds odds =
      tile.studies->odds->of_line({sight.from, sight.to, !sight.eye.absolute, !sight.eye.target_absolute}, *scratch_);
  // A hidden cell that no ground hides is behind missing ground that blocks.
  if (!sight.seen && odds.clear && nodata_ == NoData::kBlock) return;
  probabilities_[view.cell] = std::max(probabilities_[view.cell], static_cast<float>(odds.probability));
}

void ProbabilityObservation::store_row(std::size_t cell, std::size_t columns, std::size_t place, Result& result) const {
  for (std::size_t i = 0; i < columns; ++i)
    result.get<Probabilities>().probability[place + i] =
        verdicts()[cell + i] == Verdict::kOutside ? std::numeric_limits<float>::quiet_NaN() : probabilities_[cell + i];
}

}  // namespace itin::viewshed
