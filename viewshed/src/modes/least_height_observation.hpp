// The height mode: how high a target in a cell must be for some observer to see it.
#pragma once

#include "modes/observation.hpp"

namespace itin::viewshed {

class LeastHeightObservation final : public Observation {
 public:
  /// Observes one tile.
  LeastHeightObservation();

  bool open(const CellView& view) const override;
  bool asks_of_the_hidden() const override { return true; }
  std::uint64_t observe(const TileView& tile) override;

 private:
  void store_row(const StoredRow& row, Result& result) const override;
  /// The ends of one observer's lines, grid units.
  struct Ends {
    TileValues<double> lowest;
    TileValues<double> wanted;  ///< the target that counts as visible
  };
  bool raise(const TileView& tile, const CellView& view, Ends& ends);
  void record(const TileView& tile, const CellView& view, const Ends& ends);

  // Heights in metres above the ground; infinity where no height is seen.
  TileValues<double> least_;
  TileValues<double> open_;  ///< the heights that known ground asks for, where lines cross ground without data
};

}  // namespace itin::viewshed
