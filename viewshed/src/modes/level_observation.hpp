// The level mode: what a receiver in each cell gets from the best observer.
#pragma once

#include "modes/path_observation.hpp"

namespace itin::viewshed {

class LevelObservation final : public PathObservation {
 public:
  /// The request must outlive this.
  explicit LevelObservation(const Request& request);

 private:
  void take(std::size_t cell, const LineLosses::Loss& loss) override;
  void store_row(const StoredRow& row, Result& result) const override;

  const Request& request_;
  TileValues<float> level_;   ///< minus infinity where no observer has a known one
  TileValues<float> outage_;  ///< minutes of a year; infinity where none is known
};

}  // namespace itin::viewshed
