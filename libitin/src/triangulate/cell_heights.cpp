#include <algorithm>
#include <limits>

#include <itin/cell_heights.hpp>
#include <itin/silent_progress.hpp>
#include <itin/triangulate.hpp>

#include "triangulate/heights.hpp"

namespace itin {

namespace {

constexpr std::int64_t kTileSide = 256;  ///< cells of a tile, which are read together

/// The centres of the cells of a tile that the window contains, and the places of these cells in the raster.
struct TileCentres {
  std::vector<Point2> centres;
  std::vector<std::size_t> cells;
};

TileCentres centres_within(const CellsWithin& where, RasterGrid::Cell north_west) {
  const RasterGrid& cells = where.cells;
  TileCentres found;
  for (std::int64_t r = north_west.row; r < std::min(north_west.row + kTileSide, cells.rows()); ++r) {
    for (std::int64_t c = north_west.column; c < std::min(north_west.column + kTileSide, cells.columns()); ++c) {
      const Point2 centre = cells.centre(c, r);
      if (!where.window.contains(centre)) continue;
      found.centres.push_back(centre);
      found.cells.push_back(cells.index({c, r}));
    }
  }
  return found;
}

}  // namespace

CellHeights cell_heights(const Store& store, const CellsWithin& where, const Detail& detail, const ThemeChoice& themes,
                         Progress& progress) {
  const RasterGrid& cells = where.cells;
  CellHeights raster{std::vector<float>(cells.cell_count(), std::numeric_limits<float>::quiet_NaN()), {}};
  SilentProgress quiet(progress);
  for (std::int64_t row = 0; row < cells.rows(); row += kTileSide) {
    for (std::int64_t column = 0; column < cells.columns(); column += kTileSide) {
      const TileCentres tile = centres_within(where, {column, row});
      const RetrievedHeights found = retrieve_heights(store, tile.centres, detail, themes, quiet);
      raster.statistics += found.statistics;
      for (std::size_t i = 0; i < tile.cells.size(); ++i)
        if (found.metres[i]) raster.metres[tile.cells[i]] = static_cast<float>(*found.metres[i]);
    }
    progress.report("heights",
                    static_cast<double>(std::min(row + kTileSide, cells.rows())) / static_cast<double>(cells.rows()));
  }
  return raster;
}

std::vector<float> heights_at(const Store& store, const RasterGrid& cells, const Detail& detail,
                              const ThemeChoice& themes, Progress& progress) {
  return cell_heights(store, {cells, Window::all()}, detail, themes, progress).metres;
}

}  // namespace itin
