// Ground that is kept is what is measured anew, to the last bit, and takes no more than its memory.
#include "scene/kept_ground.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "scene/exact_scene.hpp"
#include "support/delaunay_tin.hpp"
#include "support/same_bits.hpp"
#include "support/seed.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

/// Compares the ground of every tile with what a surface without kept ground finds.
void expect_same_ground(const KeptGround& kept, const Tin& tin, const RasterGrid& grid) {
  const RasterGrid tiles = grid_of_tiles(grid);
  const ExactScene anew(tin, nullptr, Earth::flat(), grid, tiles);
  for (const std::int64_t step : {9, 3, 1}) {
    const SteppedTiles stepped(grid, step);
    for (std::size_t i = 0; i < stepped.count(); ++i) {
      const Tile tile = stepped.tile(i);
      const auto expected = anew.begin(tile, {&tile, 1});
      TileValues<double> found;
      kept.find(grid, tile, expected->centres, found);
      for_each_cell(tile, [&](std::size_t cell, RasterGrid::Cell) {
        ASSERT_TRUE(test::same_bits(found[cell], expected->ground[cell])) << step << ", " << i << ", " << cell;
      });
    }
  }
}

/// Rasters of many sizes of cells, about the corner of a terrain; on multiples and not.
std::vector<RasterGrid> rasters(Point2 corner) {
  std::vector<RasterGrid> all;
  for (const double cell : {20.0, 2.0, 0.5, 0.3})
    for (const double shift : {0.0, 37.0, 90.0})
      all.push_back(RasterGrid::aligned({corner.x - 40 * cell + shift * cell, corner.y - 30 * cell + shift * cell,
                                         corner.x + (60 + shift) * cell, corner.y + (80 + shift) * cell},
                                        cell));
  all.emplace_back(Point2{corner.x - 7.7, corner.y + 90.1}, 2, 3, 70, 66);
  return all;
}

TEST(KeptGround, IsWhatIsMeasuredAnew) {
  std::mt19937 random(test::seed());
  const Tin lattice = test::lattice_tin(60, 50, 10, [&](std::int32_t c, std::int32_t r) {
    return c > 20 && c < 24 && r > 8 ? std::nan("") : std::uniform_real_distribution(0.0, 30.0)(random);
  });
  const Tin scattered = test::random_tin(random, 700, 0.1);
  for (const Tin* const tin : {&lattice, &scattered}) {
    const auto cache = std::make_shared<GroundCache>(std::uint64_t{1} << 30);
    const auto heights = std::make_shared<BinnedHeights>(*tin);
    const KeptGround by_bins(heights, tin, cache), by_triangles(*tin, cache);
    const Box box = tin->bounds();
    for (const RasterGrid& grid : rasters({(box.xmin + box.xmax) / 2, (box.ymin + box.ymax) / 2})) {
      expect_same_ground(by_bins, *tin, grid);
      expect_same_ground(by_triangles, *tin, grid);
    }
    EXPECT_GT(cache->bytes(), 0U);
  }
}

TEST(KeptGround, IsMeasuredOnceForRastersThatShareCells) {
  const Tin tin = test::fractal_tin(65, 10, 20, 0.6, 4);
  const auto cache = std::make_shared<GroundCache>(std::uint64_t{1} << 30);
  const KeptGround kept(std::make_shared<BinnedHeights>(tin), &tin, cache);
  const auto look = [&](double east, double cell) {
    const RasterGrid grid({300096 + east, 200512}, cell, cell, 100, 100);
    const SteppedTiles tiles(grid, 1);
    for (std::size_t i = 0; i < tiles.count(); ++i) {
      TileValues<double> ground;
      kept.find(grid, tiles.tile(i), TileCentres(tin.grid, grid, tiles.tile(i)), ground);
    }
    return cache->bytes();
  };
  const std::uint64_t first = look(0, 2);
  EXPECT_EQ(look(2, 2), first);
  EXPECT_EQ(look(26, 2), first);
  EXPECT_GT(look(400, 2), first);
  const std::uint64_t before = cache->bytes();
  EXPECT_EQ(look(0, 2.3), before) << "cells of 2.3 metres have no exact places";
}

TEST(GroundCache, DropsWhatWasUsedLongestAgo) {
  constexpr std::uint64_t kTile = sizeof(TileValues<double>);
  GroundCache cache(3 * kTile);
  std::vector<std::int64_t> made;
  const auto get = [&](std::int64_t column) {
    return cache.get({0, 1, 1, column, 0}, [&] {
      made.push_back(column);
      return std::make_shared<TileValues<double>>();
    });
  };
  for (const std::int64_t column : {1, 2, 3, 1, 4, 1, 2}) std::ignore = get(column);
  EXPECT_EQ(made, (std::vector<std::int64_t>{1, 2, 3, 4, 2}));
  EXPECT_EQ(cache.bytes(), 3 * kTile);
  const GroundCache::Heights held = get(2);
  cache.limit(0);
  EXPECT_EQ(cache.bytes(), 0U);
  EXPECT_EQ(get(2)->size(), held->size()) << "what is in use stays";
}

}  // namespace
}  // namespace itin::viewshed
