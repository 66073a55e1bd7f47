// Heights at cell centres against the brute-force surface; no centre may fall between two triangles.
#include "bounds/surface_heights.hpp"

#include <cmath>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include "bounds/triangle_bins.hpp"
#include "support/delaunay_tin.hpp"
#include "support/exact_line_of_sight.hpp"
#include "support/seed.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

void compare(const Tin& tin, const RasterGrid& grid) {
  const test::ExactLineOfSight exact(tin, Earth::flat());
  const RasterGrid tiles = grid_of_tiles(grid);
  const TriangleBins bins(tin, tiles);
  TileValues<double> heights;
  int inside = 0;
  for (std::size_t i = 0; i < tiles.cell_count(); ++i) {
    const Tile tile = tile_at(grid, tiles, i);
    scan_convert(tin, bins.triangles(i), tile, TileCentres(tin.grid, grid, tile), heights);
    for (std::int64_t r = 0; r < tile.rows; ++r) {
      for (std::int64_t c = 0; c < tile.columns; ++c) {
        const Point2 centre = grid.centre(tile.column + c, tile.row + r);
        const double height = heights[static_cast<std::size_t>(r * Tile::kSide + c)] * tin.grid.resolution;
        if (std::isnan(height)) {
          EXPECT_FALSE(exact.height(centre, -1e-6)) << centre.x << "," << centre.y;
        } else {
          ++inside;
          const auto expected = exact.height(centre, 1e-6);
          ASSERT_TRUE(expected) << centre.x << "," << centre.y;
          EXPECT_NEAR(height, *expected, 1e-6) << centre.x << "," << centre.y;
        }
        const auto alone = surface_height(tin, bins.triangles(i), centre);
        EXPECT_EQ(alone.has_value(), !std::isnan(height));
      }
    }
  }
  EXPECT_GT(inside, 500);
}

TEST(SurfaceHeights, OnALatticeWhoseEdgesRunThroughTheCentres) {
  const Tin tin = test::fractal_tin(33, 10, 20, 0.6, 4);
  const Box box = tin.bounds();
  compare(tin, RasterGrid({box.xmin - 5, box.ymax + 5}, 10, 10, 33, 33));    // on vertices
  compare(tin, RasterGrid({box.xmin - 2.5, box.ymax + 2.5}, 5, 5, 66, 66));  // on vertices, edges and diagonals
  compare(tin, RasterGrid({box.xmin - 33.3, box.ymax + 7.7}, 3.7, 6.1, 110, 60));
}

TEST(SurfaceHeights, OverASquareAreThoseOverItsTriangles) {
  std::mt19937 random(test::seed());
  std::uniform_int_distribution<std::int32_t> place(-2'000'000, 2'000'000), height(-500'000, 500'000), side(1, 9000);
  std::uniform_real_distribution<double> part(1e-6, 1 - 1e-6);
  for (int i = 0; i < 20000; ++i) {
    const FallingSquare s{place(random),  place(random),  side(random),  height(random),
                          height(random), height(random), height(random)};
    const Point2 p{s.west + part(random) * s.side, s.south + part(random) * s.side};
    const std::int32_t east = s.west + s.side, north = s.south + s.side;
    const GridPoint sw{s.west, s.south, s.sw}, se{east, s.south, s.se}, ne{east, north, s.ne}, nw{s.west, north, s.nw};
    const auto first = height_over(std::array{sw, se, nw}, p), second = height_over(std::array{se, ne, nw}, p);
    ASSERT_TRUE(first || second);
    EXPECT_EQ(height_over(s, p), first ? *first : *second);
  }
}

/// Whichever triangle comes first, as it does in one window or another.
TEST(SurfaceHeights, OnAnEdgeBothTrianglesHaveOneHeight) {
  std::mt19937 random(test::seed());
  std::uniform_int_distribution<std::int32_t> place(1, 2'000'000), height(-500'000, 500'000);
  for (int i = 0; i < 20000; ++i) {
    const GridPoint south{0, 0, height(random)}, north{0, place(random), height(random)};
    const GridPoint west{-place(random), place(random), height(random)}, east{place(random), 0, height(random)};
    const Point2 p{0, static_cast<double>(place(random) % (north.y + 1))};
    const auto one = height_over(std::array{south, north, west}, p),
               other = height_over(std::array{south, east, north}, p);
    ASSERT_TRUE(one && other);
    ASSERT_EQ(*one, *other);
  }
}

TEST(SurfaceHeights, OnRandomTinsWithHoles) {
  std::mt19937 random(test::seed());
  for (int i = 0; i < 5; ++i) {
    const Tin tin = test::random_tin(random, 200, 0.1, {{500000, 4000000}, 0.01}, 20000);
    compare(tin, RasterGrid::aligned(tin.bounds(), 7));
  }
}

}  // namespace
}  // namespace itin::viewshed
