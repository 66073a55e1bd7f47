// Ground tiles beneath many lines at once are those beneath each of them.
#include "plan/ground_tiles.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/progress.hpp>

#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin::viewshed {
namespace {

class GroundTilesOfHills : public testing::Test {
 protected:
  static constexpr double kWest = 300000, kNorth = 204000, kStep = 20;
  static constexpr int kPostsPerSide = 200;

  void SetUp() override {
    test::write_raster(directory_.file("hills.tif"), {kWest, kNorth, kStep, kPostsPerSide, kPostsPerSide, 27700},
                       [](int c, int r) { return 100 + 30 * std::sin(c * 0.2) * std::cos(r * 0.3); });
    ImportOptions options;
    options.sources = {directory_.file("hills.tif")};
    NoProgress progress;
    import_terrain(directory_.file("hills.itin"), options, progress);
  }

  double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  /// In the hills or up to a fifth of their width outside.
  Point2 place() {
    const double width = kStep * kPostsPerSide;
    return {kWest + draw(-0.2, 1.2) * width, kNorth - draw(-0.2, 1.2) * width};
  }
  /// Some are one place, and some one line.
  Box box() {
    Box result;
    result.extend(place());
    const Point2 longest{draw(0, 1) < 0.2 ? 0.0 : 900.0, draw(0, 1) < 0.2 ? 0.0 : 900.0};
    result.extend(Point2{result.xmin + draw(0, longest.x), result.ymin + draw(0, longest.y)});
    return result;
  }

  const test::TemporaryDirectory directory_;
  std::mt19937 random_{test::seed()};
};

TEST_F(GroundTilesOfHills, BeneathLinesToABoxAreThoseBeneathEachOfThem) {
  const Store store(directory_.file("hills.itin"));
  const double width = kStep * kPostsPerSide;
  const Box hills{kWest, kNorth - width, kWest + width, kNorth};
  const GroundTiles ground(store, 0, hills, 40);
  ASSERT_GT(ground.count(), 900U);
  for (int turn = 0; turn < 60; ++turn) {
    SCOPED_TRACE(turn);
    const Point2 eye = place();
    const Box targets = box();
    TileSet each(ground.count()), all(ground.count());
    constexpr int kSteps = 60;  // so that lines lie closer than tiles are wide
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j)
        ground.add_line(
            eye, {targets.xmin + targets.width() * i / kSteps, targets.ymin + targets.height() * j / kSteps}, each);
    }
    ground.add_lines(eye, targets, all);
    std::size_t lines = 0, more = 0;
    each.for_each([&](std::size_t tile) {
      EXPECT_TRUE(all.contains(tile)) << tile;
      ++lines;
    });
    all.for_each([&](std::size_t tile) { more += each.contains(tile) ? 0 : 1; });
    // Beyond the ground every line has a tile at its border.
    if (hills.contains(eye) && hills.contains({targets.xmin, targets.ymin}) &&
        hills.contains({targets.xmax, targets.ymax})) {
      EXPECT_LE(more, lines / 20 + 1);
    }
  }
}

}  // namespace
}  // namespace itin::viewshed
