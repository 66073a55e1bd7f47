// The Fresnel mode: which cells are in sight with their zones clear.
#pragma once

#include "modes/observation.hpp"

namespace itin::viewshed {

class ZoneObservation final : public Observation {
 public:
  bool open(const CellView& view) const override { return verdicts().open(view.cell); }

 private:
  void qualify(const TileView& tile, TileValues<Verdict>& values) override;
};

}  // namespace itin::viewshed
