// The probability mode: how probably a cell is seen where heights are uncertain.
#pragma once

#include <optional>

#include "modes/lines/visibility_probability.hpp"
#include "modes/observation.hpp"

namespace itin::viewshed {

class ProbabilityObservation final : public Observation {
 public:
  /// Observes one tile.
  ProbabilityObservation();

  bool asks_of_the_hidden() const override { return true; }
  std::uint64_t observe(const TileView& tile) override;

 private:
  void study(const TileView& tile, const CellView& view, const Sight& sight) override;
  void keep(const CellView& view) override;
  void store_row(const StoredRow& row, Result& result) const override;

  std::optional<VisibilityProbability::Scratch> scratch_;  ///< made for the surface looked at
  TileValues<float> known_;                                ///< the greatest over several observers
  TileValues<float> open_;                                 ///< the greatest, of lines that ground without data may hide
};

}  // namespace itin::viewshed
