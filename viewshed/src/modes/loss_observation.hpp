// The loss mode: what a radio path from the best observer to each cell loses.
#pragma once

#include "modes/path_observation.hpp"

namespace itin::viewshed {

class LossObservation final : public PathObservation {
 public:
  explicit LossObservation(NoData nodata);

 private:
  void take(std::size_t cell, const LineLosses::Loss& loss) override;
  void store_row(const StoredRow& row, Result& result) const override;

  TileValues<float> diffraction_, free_space_;  ///< infinity where no observer has a known one
};

}  // namespace itin::viewshed
