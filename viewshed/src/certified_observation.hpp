// The certified mode over the full surface: what no ground decides but some that is missing stays open.
#pragma once

#include "observation.hpp"

namespace itin::viewshed {

class CertifiedObservation final : public Observation {
 public:
  CertifiedObservation() { doubted_.fill(false); }

  bool open(const Look& look) const override { return value(look.cell) != kVisible; }
  void doubt(std::size_t cell) override { doubted_[cell] = true; }

 private:
  std::uint8_t verdict(std::size_t cell) const;
  void store_row(std::size_t cell, std::size_t columns, std::size_t place, Result& result) const override;
  void count_row(std::size_t cell, std::size_t columns, CellCounts& cells) const override;

  TileValues<bool> doubted_;  ///< by some observer
};

}  // namespace itin::viewshed
