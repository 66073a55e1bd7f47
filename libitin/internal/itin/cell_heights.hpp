// The surface as a raster of heights, and what was read for it.
//
//   const CellHeights heights = cell_heights(store, {cells, window}, detail, themes, progress);
#pragma once

#include <vector>

#include <itin/detail.hpp>
#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <itin/tin.hpp>
#include <itin/window.hpp>

namespace itin {

struct CellHeights {
  std::vector<float> metres;  ///< row by row; NaN where there is no ground
  RetrievalStatistics statistics;
};

/// The cells of a raster whose centres a window contains.
struct CellsWithin {
  const RasterGrid& cells;
  const Window& window;
};

/// Finds the heights as heights_at() does for a raster; NaN for the other cells of the raster as well. Memory: 4 bytes
/// for each cell of the raster, and some for 65,536 cells at a time.
CellHeights cell_heights(const Store& store, const CellsWithin& where, const Detail& detail, const ThemeChoice& themes,
                         Progress& progress);

}  // namespace itin
