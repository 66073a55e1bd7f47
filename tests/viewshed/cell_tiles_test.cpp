// Every cell is in one tile, and boxes hold what they are about.
#include "line/cell_tiles.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace itin::viewshed {
namespace {

/// A grid of three by two tiles, the last ones not whole.
const RasterGrid kGrid({5000, 9000}, 20, 10, 150, 90);

TEST(CellTiles, HoldEveryCellOnce) {
  const RasterGrid tiles = grid_of_tiles(kGrid);
  ASSERT_EQ(tiles.cell_count(), 6U);
  std::vector<int> by_cell(kGrid.cell_count()), by_row(kGrid.cell_count());
  for (std::size_t i = 0; i < tiles.cell_count(); ++i) {
    const Tile tile = tile_at(kGrid, tiles, i);
    for_each_cell(tile, [&](std::size_t cell, RasterGrid::Cell place) {
      EXPECT_EQ(tile.cell(place), cell);
      ++by_cell[kGrid.index(place)];
    });
    for_each_row(tile, [&](std::size_t cell, RasterGrid::Cell place) {
      EXPECT_EQ(tile.cell(place), cell);
      for (std::int64_t c = 0; c < tile.columns; ++c) ++by_row[kGrid.index({place.column + c, place.row})];
    });
  }
  EXPECT_EQ(by_cell, std::vector<int>(kGrid.cell_count(), 1));
  EXPECT_EQ(by_row, by_cell);
}

/// Every cell that lies amid a square of 3 or 9 cells on a multiple of its size, and no other.
TEST(CellTiles, HoldEveryThirdOrNinthCellOnce) {
  for (const RasterGrid& grid : {kGrid, RasterGrid({-70, 45}, 10, 5, 700, 600), RasterGrid({30, -25}, 10, 5, 4, 4)}) {
    for (const std::int64_t step : {9, 3, 1}) {
      const SteppedTiles tiles(grid, step);
      std::vector<int> times(grid.cell_count()), expected(grid.cell_count());
      for (std::size_t i = 0; i < tiles.count(); ++i) {
        const Tile tile = tiles.tile(i);
        EXPECT_TRUE(tile.columns <= Tile::kSide && tile.rows <= Tile::kSide);
        for_each_cell(tile, [&](std::size_t cell, RasterGrid::Cell place) {
          EXPECT_EQ(tile.cell(place), cell);
          ++times[grid.index(place)];
        });
      }
      const auto amid = [&](double centre, double side) {
        const double squares = centre / (side * static_cast<double>(step));
        return std::abs(squares - std::floor(squares) - 0.5) < 1e-9;
      };
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const RasterGrid::Cell place = place_of(grid, i);
        const Point2 centre = grid.centre(place.column, place.row);
        expected[i] = amid(centre.x, grid.cell_width()) && amid(centre.y, grid.cell_height()) ? 1 : 0;
      }
      EXPECT_EQ(times, expected) << step;
    }
  }
}

TEST(CellTiles, PlacesAndIndicesAreInverse) {
  for (std::size_t i = 0; i < kGrid.cell_count(); i += 7) EXPECT_EQ(kGrid.index(place_of(kGrid, i)), i);
}

TEST(CellTiles, CentresAreThoseOfTheGridInItsUnits) {
  const Grid units{{4000, 8000}, 0.5};
  const Tile tile = tile_at(kGrid, grid_of_tiles(kGrid), 5);
  const TileCentres centres(units, kGrid, tile);
  for_each_cell(tile, [&](std::size_t cell, RasterGrid::Cell place) {
    const Point2 expected = kGrid.centre(place.column, place.row);
    EXPECT_EQ(centres.at(cell).x, (expected.x - 4000) / 0.5);
    EXPECT_EQ(centres.at(cell).y, (expected.y - 8000) / 0.5);
  });
}

TEST(CellTiles, HaveBoxes) {
  EXPECT_EQ(box_of(kGrid, Tile{64, 64, 64, 26}), (Box{6280, 8100, 7560, 8360}));
  EXPECT_EQ(box_of_centres(kGrid, Tile{64, 64, 64, 26}), (Box{6290, 8105, 7550, 8355}));
  EXPECT_EQ(box_of_cell(kGrid, {149, 89}), (Box{7980, 8100, 8000, 8110}));
}

TEST(CellTiles, DistancesAreToTheNearestPlaceOfABox) {
  const Box box{0, 0, 10, 4};
  EXPECT_EQ(squared_distance({5, 2}, box), 0);
  EXPECT_EQ(squared_distance({12, 2}, box), 4);
  EXPECT_EQ(squared_distance({-3, 8}, box), 25);
}

}  // namespace
}  // namespace itin::viewshed
