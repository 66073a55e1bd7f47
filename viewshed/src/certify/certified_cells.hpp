// The verdicts of all eyes together on the cells, judged for one eye after another.
//
//   CertifiedCells cells(grid, tiles, stage);
//   for (const Eye& eye : eyes)
//     cells.judge(BlockJudge(envelope, request, grid, tiles, eye, nullptr), all_cells(grid, tiles, within));
//   cells.store(result);
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <viewshed/result.hpp>

#include "judge/tile_judge.hpp"
#include "line/tile_parts.hpp"
#include "line/verdicts.hpp"
#include "progress/stage.hpp"

namespace itin::viewshed {

class CertifiedCells {
 public:
  /// Every cell judged for an eye is a step of the stage. All must outlive it.
  CertifiedCells(const RasterGrid& grid, const RasterGrid& tiles, Stage& stage)
      : grid_(grid), tiles_(tiles), stage_(stage), verdicts_(tiles.cell_count()) {}

  /// Judges cells for the first eye of `judge`. A cell that an eye certainly saw before is not judged again. Throws
  /// Cancelled.
  void judge(const TileJudge& judge, std::span<const PartsOfTile> cells);

  /// Writes the verdicts to the result, and adds the counts and the sight lines to the result's.
  void store(Result& result) const;

 private:
  std::uint64_t judge(const TileJudge& judge, const PartsOfTile& cells);

  const RasterGrid& grid_;
  const RasterGrid& tiles_;
  Stage& stage_;
  std::vector<Verdicts> verdicts_;  ///< each tile's
  std::uint64_t lines_ = 0;
};

}  // namespace itin::viewshed
