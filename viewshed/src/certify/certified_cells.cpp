#include "certify/certified_cells.hpp"

#include <atomic>

#include <itin/parallel.hpp>

namespace itin::viewshed {

void CertifiedCells::judge(const TileJudge& judge, std::span<const PartsOfTile> cells) {
  std::atomic<std::uint64_t> lines = 0;
  stage_.for_each(cells.size(), [&](std::size_t i) {
    lines += this->judge(judge, cells[i]);
    return cell_count(cells[i].parts);
  });
  lines_ += lines;
}

std::uint64_t CertifiedCells::judge(const TileJudge& judge, const PartsOfTile& cells) {
  const Tile tile = tile_at(grid_, tiles_, cells.tile);
  Verdicts& verdicts = verdicts_[cells.tile];
  const auto open = [&](std::size_t, TileValues<Verdict>& values) {
    std::size_t count = 0;
    for_each_cell(cells, tile, [&](std::size_t cell) {
      const bool asked = verdicts.open(cell);
      values[cell] = asked ? Verdict::kUndecided : Verdict::kOutside;
      count += asked ? 1 : 0;
    });
    return count > 0;
  };
  return judge_tile(judge, cells.tile, 1, open,
                    [&](std::size_t, const TileValues<Verdict>& values, auto&) { verdicts.add(values); });
}

void CertifiedCells::store(Result& result) const {
  result.visible.resize(grid_.cell_count());
  std::vector<CellCounts> counts(verdicts_.size());
  parallel_for(verdicts_.size(),
               [&](std::size_t tile) { verdicts_[tile].store(tile_at(grid_, tiles_, tile), result, counts[tile]); });
  for (const CellCounts& of_tile : counts) result.cells += of_tile;
  result.statistics.lines += lines_;
}

}  // namespace itin::viewshed
