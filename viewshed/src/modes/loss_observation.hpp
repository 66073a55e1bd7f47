// The loss mode: what a radio path from the best observer to each cell loses.
#pragma once

#include <bitset>

#include "modes/line_losses.hpp"
#include "modes/observation.hpp"

namespace itin::viewshed {

class LossObservation final : public Observation {
 public:
  explicit LossObservation(NoData nodata);
  bool asks_of_the_hidden() const override { return true; }
  std::uint64_t observe(const TileView& tile) override;

 private:
  void study(const TileView& tile, const CellView& view, const Sight& sight) override;
  void store_row(const StoredRow& row, Result& result) const override;

  NoData nodata_;
  LineLosses::Scratch scratch_;                     ///< empty except while an observer looks
  TileValues<float> diffraction_, free_space_;      ///< infinity where no observer has a known one
  std::bitset<Tile::kSide * Tile::kSide> unknown_;  ///< cells where an observer's loss is not known
};

}  // namespace itin::viewshed
