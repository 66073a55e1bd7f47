// The blocker mode: what first hides a cell that no observer sees.
#pragma once

#include "modes/first_blocker.hpp"
#include "modes/observation.hpp"

namespace itin::viewshed {

class BlockerObservation final : public Observation {
 public:
  /// Of one tile; `blockers` must outlive it.
  explicit BlockerObservation(const FirstBlocker& blockers);

  bool open(const Look& look) const override { return value(look.cell) != Verdict::kVisible; }

 private:
  void judge(const Look& look, const Sight& sight) override;
  void store_row(std::size_t cell, std::size_t columns, std::size_t place, Result& result) const override;

  const FirstBlocker& blockers_;
  /// Of the nearest observer that was asked for so far; of two as near the first.
  TileValues<double> squared_;
  TileValues<std::uint32_t> observer_;
  TileValues<std::uint32_t> triangle_;
};

}  // namespace itin::viewshed
