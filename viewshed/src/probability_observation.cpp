#include "probability_observation.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace itin::viewshed {

ProbabilityObservation::ProbabilityObservation(const VerticalOdds& odds, NoData nodata) : odds_(odds), nodata_(nodata) {
  margins_.fill(-std::numeric_limits<double>::infinity());
}

/// At the eye itself, where nothing can come between.
void ProbabilityObservation::keep(const Look& look) {
  margins_[look.cell] = VerticalOdds::kSure;
}

void ProbabilityObservation::judge(const LookPacket& packet, const Scene& scene, Occluder& occluder) {
  const unsigned hidden = scene.hidden(packet.lines, occluder);
  for (unsigned rest = packet.lines.active; rest != 0; rest &= rest - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(rest));
    const std::size_t cell = packet.looks[i].cell;
    const bool seen = (hidden >> i & 1) == 0;
    if (seen) mark_visible(cell);
    const double margin = odds_.least_margin(packet.lines, i);
    // What no ground hides is behind missing ground that blocks.
    if (!seen && margin > 0 && nodata_ == NoData::kBlock) continue;
    margins_[cell] = std::max(margins_[cell], margin);
  }
}

void ProbabilityObservation::store_row(std::size_t cell, std::size_t columns, std::size_t place, Result& result) const {
  for (std::size_t i = 0; i < columns; ++i)
    result.probability[place + i] = value(cell + i) == kOutside
                                        ? std::numeric_limits<float>::quiet_NaN()
                                        : static_cast<float>(VerticalOdds::probability(margins_[cell + i]));
}

}  // namespace itin::viewshed
