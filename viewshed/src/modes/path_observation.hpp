// What modes of radio have in common: each line that an observer has to a cell is studied as a radio path, and a cell
// has no value where an observer's path is not known.
#pragma once

#include <bitset>

#include "modes/lines/line_losses.hpp"
#include "modes/observation.hpp"

namespace itin::viewshed {

class PathObservation : public Observation {
 public:
  bool asks_of_the_hidden() const override { return true; }
  std::uint64_t observe(const TileView& tile) override;

 protected:
  explicit PathObservation(NoData nodata) : nodata_(nodata) {}
  /// Whether ground without data leaves the path of an observer to the cell unknown.
  bool unknown(std::size_t cell) const { return unknown_[cell]; }

 private:
  /// Keeps what an observer's path to a cell loses, if it is the best so far.
  virtual void take(std::size_t cell, const LineLosses::Loss& loss) = 0;
  void study(const TileView& tile, const CellView& view, const Sight& sight) override;

  NoData nodata_;
  LineLosses::Scratch scratch_;                     ///< empty except while an observer looks
  std::bitset<Tile::kSide * Tile::kSide> unknown_;  ///< cells where an observer's path is not known
};

}  // namespace itin::viewshed
