// One observer's verdicts on their way: what is known of every cell, decided tile by tile on all threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <vector>

#include <itin/parallel.hpp>
#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <viewshed/certified.hpp>

#include "cell_tiles.hpp"

namespace itin::viewshed {

class ObserverRaster {
 public:
  /// All kUndecided. `tiles` are those of `grid`; all must outlive it.
  ObserverRaster(const RasterGrid& grid, const RasterGrid& tiles, Progress& progress)
      : grid_(grid), tiles_(tiles), progress_(progress), values_(grid.cell_count(), kUndecided) {}

  std::vector<std::uint8_t>& values() { return values_; }
  std::uint64_t rays() const { return rays_; }

  /// Calls decide(i, values), which returns how many rays it took, with the values of tile `tiles[i]`, and keeps what
  /// becomes of them. Throws Cancelled.
  template <class Decide>
  void judge(const std::vector<std::size_t>& tiles, const Decide& decide) {
    parallel_for(tiles.size(), [&](std::size_t i) {
      progress_.throw_if_cancelled();
      const Tile tile = tile_at(grid_, tiles_, tiles[i]);
      TileValues<std::uint8_t> values;
      values.fill(kOutside);
      const auto columns = static_cast<std::size_t>(tile.columns);
      for_each_row(tile, [&](std::size_t cell, RasterGrid::Cell place) {
        std::copy_n(values_.data() + grid_.index(place), columns, values.data() + cell);
      });
      rays_ += decide(i, values);
      for_each_row(tile, [&](std::size_t cell, RasterGrid::Cell place) {
        std::copy_n(values.data() + cell, columns, values_.data() + grid_.index(place));
      });
      report(tile);
    });
  }

 private:
  void report(const Tile& tile) {
    std::uint64_t now = 0;
    for_each_row(tile, [&](std::size_t, RasterGrid::Cell place) {
      const auto first = values_.begin() + static_cast<std::ptrdiff_t>(grid_.index(place));
      now += static_cast<std::uint64_t>(tile.columns - std::count(first, first + tile.columns, kUndecided));
    });
    const std::lock_guard lock(mutex_);
    std::uint64_t& before = decided_[grid_.index({tile.column, tile.row})];
    done_ += now - before;
    before = now;
    progress_.report("cells decided", static_cast<double>(done_) / static_cast<double>(values_.size()));
  }

  const RasterGrid& grid_;
  const RasterGrid& tiles_;
  Progress& progress_;
  std::vector<std::uint8_t> values_;
  std::atomic<std::uint64_t> rays_ = 0;
  std::mutex mutex_;
  std::map<std::size_t, std::uint64_t> decided_;  ///< cells of each tile
  std::uint64_t done_ = 0;
};

}  // namespace itin::viewshed
