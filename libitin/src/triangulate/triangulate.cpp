#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include <itin/call_progress.hpp>
#include <itin/parallel.hpp>
#include <itin/sort_unique.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "base/stoppable.hpp"
#include "triangulate/assembly.hpp"
#include "triangulate/raised_index.hpp"
#include "triangulate/region/region.hpp"
#include "triangulate/region/window_leaves.hpp"
#include "triangulate/selected_tin.hpp"

namespace itin {

namespace {

/// Windows of more points than this are cut into quadtree cells: few enough points to keep a cell's triangulation in
/// the processor's cache. There are several cells for each thread of an ordinary machine, but each has enough points
/// that reading beyond its border is not the main cost. No result depends on it.
constexpr double kMostPerTile = 32768, kLeastPerTile = 16384, kTiles = 8;

std::uint64_t points_of(const std::vector<Leaf>& leaves) {
  return std::accumulate(leaves.begin(), leaves.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Leaf& leaf) { return sum + leaf.asked; });
}

/// Cuts a window into cells that cover it.
class TilePlan {
 public:
  TilePlan(const PointIndex& index, const Selection& selection, const GridWindow& window)
      : index_(index), selection_(selection), window_(window) {
    selected_leaves(index_, selection_, window_.bounds(), leaves_);
    std::vector<std::uint32_t> all(leaves_.size());
    std::iota(all.begin(), all.end(), 0U);
    const auto points = static_cast<double>(points_of(leaves_));
    if (points > kMostPerTile) per_tile_ = std::clamp(points / kTiles, kLeastPerTile, kMostPerTile);
    split(Cell{}, all);
  }

  const std::vector<Cell>& cells() const { return cells_; }

 private:
  void split(const Cell& cell, const std::vector<std::uint32_t>& leaves) {
    const GridBox square = square_of(cell);
    if (!window_.meets(square)) return;
    double points = 0;
    std::vector<std::uint32_t> inside;
    for (const std::uint32_t i : leaves) {
      const Cell& leaf = leaves_[i].cell;
      if (!cell.contains(leaf) && !leaf.contains(cell)) continue;
      inside.push_back(i);
      points += leaves_[i].asked * std::min(1.0, std::ldexp(1.0, 2 * (cell.log2_side - leaf.log2_side)));
    }
    if (points <= per_tile_ || cell.log2_side == 0) {
      cells_.push_back(cell);
      return;
    }
    for (int i = 0; i < 4; ++i) split(cell.child(i), inside);
  }

  const PointIndex& index_;
  const Selection& selection_;
  const GridWindow& window_;
  std::vector<Leaf> leaves_;
  double per_tile_ = kMostPerTile;
  std::vector<Cell> cells_;
};

/// Gives lines of a part their theme's number. Drops lines that only keep the ground about raised features.
void name_themes(Tin& tin, const StoreMetadata& metadata) {
  if (metadata.parts.empty()) return;
  std::erase_if(tin.lines, [&](const LineEdge& e) {
    return e.theme <= metadata.themes.size() && metadata.themes[e.theme - std::size_t{1}].is_raised();
  });
  for (LineEdge& e : tin.lines) {
    if (e.theme > metadata.themes.size()) e.theme = metadata.parts[e.theme - metadata.themes.size() - 1].theme;
  }
  sort_unique(tin.lines);
}

}  // namespace

Tin triangulate_selected(const Store& store, const Window& window, const Selection& selection, Progress& progress) {
  const Stoppable stoppable(progress);
  const StoreMetadata& metadata = store.metadata();
  const GridWindow grid_window(window, metadata.grid, metadata.bounds);
  const RaisedIndex index(store, selection);
  const TilePlan plan(index, selection, grid_window);

  std::vector<RegionMesh> regions(plan.cells().size());
  CallProgress call(progress);
  std::atomic<std::size_t> done = 0;
  parallel_for(regions.size(), [&](std::size_t i) {
    progress.throw_if_cancelled();
    const Cell& cell = plan.cells()[i];
    regions[i] = triangulate_region(index, selection, square_of(cell), window.is_all() ? nullptr : &grid_window);
    call.report("triangulating", static_cast<double>(++done) / static_cast<double>(regions.size()));
  });
  Tin tin = assemble(std::move(regions), plan.cells(), metadata.grid);
  name_themes(tin, metadata);
  call.finish();
  return tin;
}

Tin triangulate(const Store& store, const Window& window, const Detail& detail, Progress& progress,
                const ThemeChoice& themes) {
  return triangulate_selected(store, window, selection_of(store.metadata(), detail, themes), progress);
}

std::uint64_t points_about(const Store& store, const Window& window, const Detail& detail, const ThemeChoice& themes) {
  const StoreMetadata& metadata = store.metadata();
  const Selection selection = selection_of(metadata, detail, themes);
  const GridWindow grid_window(window, metadata.grid, metadata.bounds);
  return points_of(leaves_about(store.points(), selection, grid_window, 0));
}

}  // namespace itin
