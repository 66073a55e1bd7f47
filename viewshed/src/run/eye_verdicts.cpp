#include "run/eye_verdicts.hpp"

#include <atomic>
#include <numeric>

#include <itin/parallel.hpp>

#include "line/infinity.hpp"
#include "line/verdicts.hpp"
#include "request/cells_in_view.hpp"

namespace itin::viewshed {

EyeVerdicts::EyeVerdicts(ViewshedCells& cells, const Grid& units, const Eye& eye, std::uint32_t observer)
    : cells_(cells), units_(units), eye_(eye), observer_(observer), verdicts_(cells.tiles().cell_count()) {
  parallel_for(verdicts_.size(), [&](std::size_t tile) { ask(tile); });
}

/// Calls visit(view) for every cell of a tile; the views know no heights.
template <class Visit>
void EyeVerdicts::for_each_view(std::size_t tile, const Visit& visit) const {
  const RasterGrid& grid = cells_.result().grid;
  const Tile place = tile_at(grid, cells_.tiles(), tile);
  for_each_offset(eye_, grid, place, TileCentres(units_, grid, place), [&](std::size_t cell, const Point2& offset) {
    visit(CellView{cell, observer_, offset.x, offset.y, 0});
  });
}

void EyeVerdicts::ask(std::size_t tile) {
  TileValues<Verdict>& verdicts = verdicts_[tile];
  verdicts.fill(Verdict::kOutside);
  const RasterGrid& grid = cells_.result().grid;
  const MapView field{eye_.position, eye_.view};
  const Box centres = box_of_centres(grid, tile_at(grid, cells_.tiles(), tile));
  if (!field.reaches(centres)) return;
  const bool all = field.holds(centres);
  const Observation& observation = cells_.of_tile(tile);
  for_each_view(tile, [&](const CellView& view) {
    const bool in_view = all || eye_.view.contains(view.dx, view.dy, -kInfinity, kInfinity) != false;
    if (in_view && observation.open(view)) verdicts[view.cell] = Verdict::kUndecided;
  });
}

void EyeVerdicts::judge(const TileJudge& judge, std::span<const std::size_t> tiles) {
  std::atomic<std::uint64_t> lines = 0;
  cells_.for_each(tiles.size(), [&](std::size_t i) {
    TileValues<Verdict>& values = verdicts_[tiles[i]];
    const std::uint64_t before = count_of(values, Verdict::kUndecided);
    if (before > 0) lines += judge.begin(tiles[i])->judge(0, values);
    return before - count_of(values, Verdict::kUndecided);
  });
  cells_.result().statistics.lines += lines;
}

void EyeVerdicts::judge(const TileJudge& judge) {
  std::vector<std::size_t> all(verdicts_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  this->judge(judge, all);
}

void EyeVerdicts::add() {
  parallel_for(verdicts_.size(), [&](std::size_t tile) {
    Observation& observation = cells_.of_tile(tile);
    for_each_view(tile, [&](const CellView& view) { observation.add(view, verdicts_[tile][view.cell]); });
  });
}

}  // namespace itin::viewshed
