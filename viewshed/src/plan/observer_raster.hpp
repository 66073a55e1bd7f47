// One observer's verdicts on their way: what is known of every cell, decided tile by tile on all threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include <itin/raster.hpp>
#include <viewshed/viewshed.hpp>

#include "line/cell_tiles.hpp"
#include "progress/stage.hpp"

namespace itin::viewshed {

class ObserverRaster {
 public:
  /// All Verdict::kUndecided. `tiles` are those of `grid`; every cell decided is a step of `stage`. All must outlive
  /// it.
  ObserverRaster(const RasterGrid& grid, const RasterGrid& tiles, Stage& stage)
      : grid_(grid), tiles_(tiles), stage_(stage), values_(grid.cell_count(), Verdict::kUndecided) {}

  std::vector<Verdict>& values() { return values_; }
  std::uint64_t rays() const { return rays_; }

  /// Calls decide(i, values), which returns how many rays it took, with the values of tile `tiles[i]`, and keeps what
  /// becomes of them. Throws Cancelled.
  template <class Decide>
  void judge(const std::vector<std::size_t>& tiles, const Decide& decide) {
    stage_.for_each(tiles.size(), [&](std::size_t i) {
      const Tile tile = tile_at(grid_, tiles_, tiles[i]);
      const auto columns = static_cast<std::size_t>(tile.columns);
      TileValues<Verdict> values;
      values.fill(Verdict::kOutside);
      for_each_row(tile, [&](std::size_t cell, RasterGrid::Cell place) {
        std::copy_n(values_.data() + grid_.index(place), columns, values.data() + cell);
      });
      const std::size_t before = undecided(values);
      rays_ += decide(i, values);
      for_each_row(tile, [&](std::size_t cell, RasterGrid::Cell place) {
        std::copy_n(values.data() + cell, columns, values_.data() + grid_.index(place));
      });
      return before - undecided(values);
    });
  }

 private:
  static std::size_t undecided(const TileValues<Verdict>& values) {
    return static_cast<std::size_t>(std::count(values.begin(), values.end(), Verdict::kUndecided));
  }

  const RasterGrid& grid_;
  const RasterGrid& tiles_;
  Stage& stage_;
  std::vector<Verdict> values_;
  std::atomic<std::uint64_t> rays_ = 0;
};

}  // namespace itin::viewshed
