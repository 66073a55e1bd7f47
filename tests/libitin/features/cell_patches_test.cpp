// Patches of rasters of heights: which cells they take, and that their outlines are simple.
#include "features/cell_patches.hpp"

#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "features/plan/plan_overlay.hpp"
#include "store/segments/footprint_codec.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

HeightCells raster(std::int32_t columns, std::int32_t rows) {
  HeightCells cells;
  cells.across = {1, 0}, cells.down = {0, -1};
  cells.columns = columns, cells.rows = rows;
  cells.step = 2000, cells.threshold = 1500;
  return cells;
}

std::int32_t steps(std::int64_t millimetres, HeightRounding rounding) {
  HeightCells rule = raster(1, 1);
  rule.rounding = rounding;
  return steps_of(millimetres, rule);
}

TEST(CellPatches, HeightsBecomeStepsByTheirRule) {
  EXPECT_EQ(steps(1499, HeightRounding::up), 0);
  EXPECT_EQ(steps(1500, HeightRounding::nearest), 1);
  EXPECT_EQ(steps(1500, HeightRounding::up), 1);
  EXPECT_EQ(steps(1500, HeightRounding::down), 0);
  EXPECT_EQ(steps(2999, HeightRounding::nearest), 1);
  EXPECT_EQ(steps(3000, HeightRounding::nearest), 2);
  EXPECT_EQ(steps(4000, HeightRounding::up), 2);
  EXPECT_EQ(steps(4001, HeightRounding::up), 3);
  EXPECT_EQ(steps(5999, HeightRounding::down), 2);
  EXPECT_EQ(steps(-4000, HeightRounding::up), 0);
  HeightCells none = raster(1, 1);
  none.threshold = 0, none.rounding = HeightRounding::up;
  EXPECT_EQ(steps_of(0, none), 0);
  EXPECT_EQ(steps_of(1, none), 1);
}

/// By the even-odd rule.
bool encloses(const std::vector<PlanRing>& rings, Point2 p) {
  bool inside = false;
  for (const PlanRing& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point2 a = ring[i], b = ring[(i + 1) % ring.size()];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
  return inside;
}

TEST(CellPatches, OfAnIslandAndItsPinchedLagoon) {
  // The lagoon's two cells meet at a corner, and so do the islands'.
  const std::vector<std::int32_t> steps{3, 3, 3, 3,  //
                                        3, 0, 3, 3,  //
                                        3, 3, 0, 3,  //
                                        3, 3, 3, 3};
  const std::vector<CellPatch> patches = patches_of(raster(4, 4), steps);
  ASSERT_EQ(patches.size(), 1U);
  EXPECT_EQ(patches[0].steps, 3);
  ASSERT_EQ(patches[0].rings.size(), 3U);
  for (const PlanRing& ring : patches[0].rings) EXPECT_EQ(ring.size(), 4U);
  EXPECT_EQ(patches_of(raster(2, 2), std::vector<std::int32_t>{1, 0, 0, 1}).size(), 2U);
  EXPECT_EQ(patches_of(raster(2, 2), std::vector<std::int32_t>{1, 2, 2, 2}).size(), 2U);
  EXPECT_TRUE(patches_of(raster(2, 2), std::vector<std::int32_t>(4, 0)).empty());
}

TEST(CellPatches, CoverTheirCellsWithSimpleRings) {
  std::mt19937 random(test::seed());
  for (int world = 0; world < 60; ++world) {
    HeightCells cells = raster(1 + static_cast<int>(random() % 12), 1 + static_cast<int>(random() % 12));
    cells.corner = {40, 70}, cells.first_column = 5, cells.first_row = 9;
    std::vector<std::int32_t> steps;
    for (int i = 0; i < cells.columns * cells.rows; ++i) steps.push_back(static_cast<std::int32_t>(random() % 3));
    const std::vector<CellPatch> patches = patches_of(cells, steps);
    for (const CellPatch& patch : patches) {
      EXPECT_GT(patch.steps, 0);
      std::vector<GridRing> on_grid;
      for (const PlanRing& ring : patch.rings) {
        std::set<std::pair<double, double>> places;
        GridRing& whole = on_grid.emplace_back();
        for (const Point2& p : ring) {
          EXPECT_TRUE(places.insert({p.x, p.y}).second) << "a ring comes to a place twice";
          whole.push_back({static_cast<std::int32_t>(p.x), static_cast<std::int32_t>(p.y)});
        }
      }
      const EvenOdd plan = even_odd(on_grid);
      EXPECT_FALSE(plan.repaired);
      EXPECT_EQ(plan.polygons.size(), 1U);
    }
    for (int row = 0; row < cells.rows; ++row)
      for (int column = 0; column < cells.columns; ++column) {
        const Point2 centre = cells.corner_at(column + 0.5, row + 0.5);
        std::int32_t found = 0;
        for (const CellPatch& patch : patches)
          if (encloses(patch.rings, centre)) found += patch.steps;
        EXPECT_EQ(found, steps[static_cast<std::size_t>(row * cells.columns + column)]);
      }
  }
}

TEST(CellPatches, HeightsSurviveTheirCode) {
  std::mt19937 random(test::seed());
  StoredFootprint footprint;
  footprint.source = 7;
  footprint.feature.kind = FeatureKind::cells;
  footprint.feature.name = "canopy.tif";
  footprint.feature.rings = {{{1, 2}, {3, 4}, {5, 6}}};
  HeightCells& cells = footprint.feature.cells.emplace(raster(9, 7));
  cells.corner = {412345.678, 1e6 / 3}, cells.absolute = true, cells.rounding = HeightRounding::down;
  cells.first_column = 640, cells.first_row = 64;
  for (int i = 0; i < 63; ++i)
    cells.heights.push_back(random() % 4 == 0 ? kNoHeight : static_cast<std::int32_t>(random() % 100000) - 5000);
  const std::vector<StoredFootprint> decoded = decode_footprints(encode_footprints(std::vector{footprint}));
  ASSERT_EQ(decoded.size(), 1U);
  EXPECT_EQ(content_of(decoded[0].feature), content_of(footprint.feature));
  EXPECT_EQ(decoded[0].feature.cells->heights, cells.heights);
  EXPECT_EQ(decoded[0].feature.cells->corner_at(1, 2).y, cells.corner_at(1, 2).y);
}

}  // namespace
}  // namespace itin
