// Which cells lie within observers' distances and azimuths, whether or not there is ground, tile by tile.
//
//   const auto asked = [&](RasterGrid::Cell place) { return counts[grid.index(place)] == kCountOutside; };
//   for_each_cell_in_view(request, grid, asked, [&](RasterGrid::Cell place) { cells[grid.index(place)] = 1; });
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <vector>

#include <itin/parallel.hpp>
#include <itin/raster.hpp>
#include <viewshed/request.hpp>

#include "line/cell_tiles.hpp"
#include "line/infinity.hpp"
#include "request/eye.hpp"
#include "request/field_of_view.hpp"

namespace itin::viewshed {

/// Calls visit(cell, offset) for every cell of a tile; the offset is that of Eye::offset_to().
template <class Visit>
void for_each_offset(const Eye& eye, const RasterGrid& grid, const Tile& tile, const TileCentres& centres,
                     const Visit& visit) {
  for_each_row(tile, [&](std::size_t cell, RasterGrid::Cell place) {
    const double dy = grid.centre_y(place.row) - eye.position.y;
    // Few rows come near the eye.
    const bool near = same_place(0, centres.at(cell).y - eye.units.y);
    const std::int64_t end = place.column + tile.columns * tile.step;
    for (; place.column < end; place.column += tile.step, ++cell) {
      const bool own = near && eye.stands_at(centres.at(cell));
      visit(cell, own ? Point2{} : Point2{grid.centre_x(place.column) - eye.position.x, dy});
    }
  });
}

/// An observer's field of view on the map, at whatever elevation.
struct MapView {
  Point2 position;
  FieldOfView view;

  bool reaches(const Box& box) const { return view.reaches(squared_distance(position, box)); }
  bool holds(const Box& box) const {
    return view.holds(squared_distance(position, box), greatest_squared_distance(position, box));
  }
  bool holds(Point2 p) const {
    return view.contains(p.x - position.x, p.y - position.y, -kInfinity, kInfinity).value_or(true);
  }
};

/// The cells of a tile that observers look at.
class TileInView {
 public:
  TileInView(const std::vector<MapView>& views, const Box& centres);

  bool empty() const { return !all_ && near_.empty(); }
  bool holds(Point2 centre) const;

 private:
  bool all_ = false;
  std::vector<const MapView*> near_;
};

std::vector<MapView> views_of(const Request& request);

/// Calls found(place), on any thread, for each cell for which asked(place) holds and that some observer looks at.
/// Returns the number of these cells.
template <class Asked, class Found>
std::uint64_t for_each_cell_in_view(const Request& request, const RasterGrid& grid, const Asked& asked,
                                    const Found& found) {
  const std::vector<MapView> views = views_of(request);
  const RasterGrid tiles = grid_of_tiles(grid);
  std::atomic<std::uint64_t> count = 0;
  parallel_for(tiles.cell_count(), [&](std::size_t i) {
    const Tile tile = tile_at(grid, tiles, i);
    const TileInView in_view(views, box_of_centres(grid, tile));
    if (in_view.empty()) return;
    std::uint64_t of_tile = 0;
    for_each_cell(tile, [&](std::size_t, RasterGrid::Cell place) {
      if (asked(place) && in_view.holds(grid.centre(place.column, place.row))) found(place), ++of_tile;
    });
    count += of_tile;
  });
  return count;
}

/// Cells beyond a grid.
struct CellsBeyond {
  RasterGrid grid;                  ///< its cells are as large as the other grid's, or larger where they would be many
  std::vector<std::uint8_t> cells;  ///< 1 where an observer looks; empty: none
  double each = 1;                  ///< how many cells of the other grid fit into one

  double count() const;  ///< in cells of the other grid
};

/// Returns the cells that observers look at beyond the grid, where the request names no cells and the grid is cut to
/// the data; none where an observer has no radius.
CellsBeyond cells_beyond(const Request& request, const RasterGrid& grid);

}  // namespace itin::viewshed
