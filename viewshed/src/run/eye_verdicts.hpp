// What one observer's lines to all cells come to, decided by one judge after another.
//
//   EyeVerdicts verdicts(cells, units, eye, observer);   // undecided: what is asked
//   verdicts.judge(coarse_judge, every_tile);
//   verdicts.judge(exact_judge, tiles_left);
//   verdicts.add();                                      // to what is known of the cells
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "judge/tile_judge.hpp"
#include "run/viewshed_cells.hpp"

namespace itin::viewshed {

class EyeVerdicts {
 public:
  /// Asks about the cells that the eye looks at, as far as it matters whether this observer sees them. `units` are the
  /// surface's. All must outlive this object.
  EyeVerdicts(ViewshedCells& cells, const Grid& units, const Eye& eye, std::uint32_t observer);

  std::size_t tile_count() const { return verdicts_.size(); }
  /// Verdict::kUndecided where a cell is still asked about, and Verdict::kOutside where it never was.
  const TileValues<Verdict>& of_tile(std::size_t tile) const { return verdicts_[tile]; }
  /// Judges what is undecided of these tiles for the judge's first eye, and counts the sight lines. Throws Cancelled.
  void judge(const TileJudge& judge, std::span<const std::size_t> tiles);
  void judge(const TileJudge& judge);
  void add();

 private:
  template <class Visit>
  void for_each_view(std::size_t tile, const Visit& visit) const;
  void ask(std::size_t tile);

  ViewshedCells& cells_;
  const Grid& units_;
  const Eye& eye_;
  std::uint32_t observer_;
  std::vector<TileValues<Verdict>> verdicts_;
};

}  // namespace itin::viewshed
