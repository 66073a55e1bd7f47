// The probability mode: how probably a cell is seen where heights are uncertain.
#pragma once

#include "modes/observation.hpp"
#include "modes/vertical_odds.hpp"

namespace itin::viewshed {

class ProbabilityObservation final : public Observation {
 public:
  /// Of one tile; `odds` must outlive it.
  ProbabilityObservation(const VerticalOdds& odds, NoData nodata);

 private:
  void judge(const Look& look, const Sight& sight) override;
  void keep(const Look& look) override;
  void store_row(std::size_t cell, std::size_t columns, std::size_t place, Result& result) const override;

  const VerticalOdds& odds_;
  NoData nodata_;
  VerticalOdds::Scratch scratch_;
  TileValues<float> probabilities_;  ///< of several observers the greatest
};

}  // namespace itin::viewshed
