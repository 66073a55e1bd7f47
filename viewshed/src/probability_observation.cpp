#include "probability_observation.hpp"

#include <algorithm>
#include <limits>

namespace itin::viewshed {

ProbabilityObservation::ProbabilityObservation(const VerticalOdds& odds, NoData nodata) : odds_(odds), nodata_(nodata) {
  margins_.fill(-std::numeric_limits<double>::infinity());
}

/// At the eye itself, where nothing can come between.
void ProbabilityObservation::keep(const Look& look) {
  margins_[look.cell] = VerticalOdds::kSure;
}

void ProbabilityObservation::judge(const Look& look, const Sight& sight) {
  if (sight.seen) mark_visible(look.cell);
  const double margin = odds_.least_margin(sight.from, sight.to, memory_);
  // What no ground hides is behind missing ground that blocks.
  if (!sight.seen && margin > 0 && nodata_ == NoData::kBlock) return;
  margins_[look.cell] = std::max(margins_[look.cell], margin);
}

void ProbabilityObservation::store_row(std::size_t cell, std::size_t columns, std::size_t place, Result& result) const {
  for (std::size_t i = 0; i < columns; ++i)
    result.probability[place + i] = value(cell + i) == kOutside
                                        ? std::numeric_limits<float>::quiet_NaN()
                                        : static_cast<float>(VerticalOdds::probability(margins_[cell + i]));
}

}  // namespace itin::viewshed
