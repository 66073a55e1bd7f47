#include "modes/probability_observation.hpp"

#include <algorithm>
#include <limits>

namespace itin::viewshed {

ProbabilityObservation::ProbabilityObservation() {
  known_.fill(0);
  open_.fill(0);
}

std::uint64_t ProbabilityObservation::observe(const TileView& tile) {
  scratch_.emplace(*tile.studies->odds);
  const std::uint64_t lines = Observation::observe(tile);
  scratch_.reset();
  return lines;
}

/// Keeps a target at the eye itself, where nothing can come between.
void ProbabilityObservation::keep(const CellView& view) {
  known_[view.cell] = 1;
}

void ProbabilityObservation::study(const TileView& tile, const CellView& view, const Sight& sight) {
  const bool over_missing = sight.verdict == Verdict::kUndecided ||
                            (sight.verdict == Verdict::kHidden && tile.crosses_void(sight.to.x, sight.to.y));
  if (over_missing && tile.from().shadow->shaded() == Verdict::kHidden) return;
  float& greatest = (over_missing ? open_ : known_)[view.cell];
  const VisibilityProbability::Line line{sight.from, sight.to, !sight.eye.absolute, !sight.eye.target_absolute};
  greatest = std::max(greatest, static_cast<float>(tile.studies->odds->of_line(line, *scratch_).probability));
}

void ProbabilityObservation::store_row(const StoredRow& row, Result& result) const {
  row.for_each([&](std::size_t cell, std::size_t place) {
    const bool known = verdicts()[cell] != Verdict::kOutside && known_[cell] >= open_[cell];
    result.get<Probabilities>().probability[place] = known ? known_[cell] : std::numeric_limits<float>::quiet_NaN();
  });
}

}  // namespace itin::viewshed
