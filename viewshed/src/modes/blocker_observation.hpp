// The blocker mode: what first hides a cell that no observer sees.
#pragma once

#include <vector>

#include "modes/blocker_table.hpp"
#include "modes/observation.hpp"

namespace itin::viewshed {

class BlockerObservation final : public Observation {
 public:
  /// Observes one tile; its blockers are numbered as in the table, which must outlive it.
  explicit BlockerObservation(BlockerTable& table);

  bool open(const CellView& view) const override { return verdicts().open(view.cell); }
  bool asks_of_the_hidden() const override { return true; }
  std::uint64_t observe(const TileView& tile) override;

 private:
  void study(const TileView& tile, const CellView& view, const Sight& sight) override;
  void store_row(const StoredRow& row, Result& result) const override;

  BlockerTable& table_;
  /// The values of the nearest observer so far; if two are equally near, the first counts.
  TileValues<double> squared_;
  TileValues<std::uint32_t> observer_;
  TileValues<std::uint32_t> blocker_;
  std::vector<std::size_t>
      found_;  ///< cells whose blocker is a triangle of the surface looked at, not yet of the table
};

}  // namespace itin::viewshed
