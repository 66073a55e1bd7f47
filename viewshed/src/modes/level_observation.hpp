// The level mode: what a receiver in each cell gets from the best observer.
#pragma once

#include "modes/path_observation.hpp"

namespace itin::viewshed {

class LevelObservation final : public PathObservation {
 public:
  /// The request must outlive this.
  explicit LevelObservation(const Request& request);
  std::uint64_t observe(const TileView& tile) override;

 private:
  void take(std::size_t cell, const LineLosses::Loss& loss) override;
  void store_row(const StoredRow& row, Result& result) const override;

  const Request& request_;
  profile::BudgetQuery budget_;         ///< that of the observer who looks
  std::uint32_t number_ = 0;            ///< the number of that observer, from 1
  TileValues<float> level_;             ///< minus infinity where no observer has a known one
  TileValues<float> outage_;            ///< minutes of a year; infinity where none is known
  TileValues<std::uint32_t> observer_;  ///< its number; 0 where none has a known level
};

}  // namespace itin::viewshed
