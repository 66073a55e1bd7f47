// The strip of ground in which a wall rises, beside neighbours of several heights: it is nowhere higher than what
// stands within the wall offset of it.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "features/mesh/terrain_heights.hpp"
#include "support/houses.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/sound_store.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

/// Metres: a corner of a wall may stand this far within its outline's, with what rounding adds; how far heights are
/// rounded, on steep ground beside walls.
constexpr double kReach = 0.09, kRounded = 0.06;
constexpr double kRow = 6;  ///< how deep a row of bricks is

/// Rows of bricks side by side, in a frame of their own: the joints of one row meet the straight sides of the next.
class Bricks {
 public:
  Bricks(std::mt19937& random, Point2 corner, double turn)
      : corner_(corner), cos_(std::cos(turn)), sin_(std::sin(turn)) {
    const auto in = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() % 1000001) / 1e6;
    };
    for (int row = 0; row < 8; ++row)
      for (double x = in(0, 5); x < 60;) {
        const double width = in(1, 14);
        bricks_.push_back({x, x + width, row * kRow, random() % 4 == 0 ? 0 : 1.0 + static_cast<double>(random() % 12)});
        x += width;
      }
  }

  std::vector<test::LineFeature> outlines() const {
    std::vector<test::LineFeature> result;
    for (const Brick& b : bricks_) {
      if (b.height == 0) continue;
      test::LineFeature& f = result.emplace_back(test::box(0, 0, 1, 1, b.height));
      f.vertices.clear();
      // With its neighbours' corners, so that rounding opens no gaps.
      const auto side = [&](double y, double beyond, bool back) {
        std::set<double> joints{b.west, b.east};
        for (const Brick& c : bricks_)
          for (const double x : {c.west, c.east})
            if (c.south == beyond && x > b.west && x < b.east) joints.insert(x);
        std::vector<double> way(joints.begin(), joints.end());
        if (back) std::reverse(way.begin(), way.end());
        for (const double x : way) f.vertices.push_back({at(x, y).x, at(x, y).y, 0});
      };
      side(b.south, b.south - kRow, false);
      side(b.south + kRow, b.south + kRow, true);
      f.vertices.push_back(f.vertices.front());
    }
    return result;
  }

  Point2 at(double x, double y) const { return {corner_.x + cos_ * x - sin_ * y, corner_.y + sin_ * x + cos_ * y}; }

  /// The least and the greatest height within reach.
  std::pair<double, double> about(Point2 p) const {
    const double dx = p.x - corner_.x, dy = p.y - corner_.y, x = cos_ * dx + sin_ * dy, y = cos_ * dy - sin_ * dx;
    double low = 1e9, high = 0;
    for (const double i : {-kReach, 0.0, kReach})
      for (const double j : {-kReach, 0.0, kReach}) {
        const double h = height(x + i, y + j);
        low = std::min(low, h), high = std::max(high, h);
      }
    return {low, high};
  }

 private:
  struct Brick {
    double west, east, south, height;
  };
  double height(double x, double y) const {
    for (const Brick& b : bricks_)
      if (x >= b.west && x < b.east && y >= b.south && y < b.south + kRow) return b.height;
    return 0;
  }

  std::vector<Brick> bricks_;
  Point2 corner_;
  double cos_, sin_;
};

class WallStrip : public testing::Test {
 protected:
  double in(double low, double high) { return low + (high - low) * static_cast<double>(random_() % 1000001) / 1e6; }
  std::string path(const std::string& name) const { return directory_.file(name); }

  /// Posts `step` metres apart, and vegetation on them.
  void build(double step, const std::vector<test::LineFeature>& vegetation) {
    const int posts = static_cast<int>(300 / step);
    test::write_raster(path("t.tif"), {300000, 200000, step, posts, posts, 27700},
                       [&](int, int) { return 100 + in(0, step / 5); });
    ImportOptions options;
    options.sources = {path("t.tif")};
    std::filesystem::remove(path("s.itin"));
    NoProgress progress;
    import_terrain(path("s.itin"), options, progress);
    const ImportReport report =
        test::import_raised(path("s.itin"), path("v.geojson"), ThemeKind::Vegetation, "vegetation", vegetation);
    EXPECT_EQ(report.refused, 0U);
  }

  Tin surface(const ThemeChoice& choice) const {
    NoProgress progress;
    return triangulate(Store(path("s.itin")), Window::all(), Detail::tolerance(0), progress, choice);
  }

  std::mt19937 random_{test::seed()};

 private:
  const test::TemporaryDirectory directory_;
};

/// Edges of the terrain cross the walls at every angle, and run along them.
TEST_F(WallStrip, IsNoHigherThanWhatStandsBesideIt) {
  for (const auto& [step, turn] : {std::pair{12.0, 0.0},
                                   {5.0, 0.0},
                                   {2.5, 0.0},
                                   {12.0, in(0, 6)},
                                   {5.0, in(0, 6)},
                                   {3.0, in(0, 0.1)},
                                   {10.0, 0.005},
                                   {30.0, 0.002}}) {
    SCOPED_TRACE(fmt::format("posts {} m apart, turned by {}", step, turn));
    const Bricks bricks(random_, {300150, 199865}, turn);
    build(step, bricks.outlines());
    test::expect_sound(Store(path("s.itin")));
    const Tin bare = surface(ThemeChoice::none()), raised = surface(ThemeChoice::all());
    const TerrainHeights ground(bare), roofs(raised);
    int too_high = 0, too_low = 0;
    double above = 0, below = 0;
    for (int i = 0; i < 100000; ++i) {
      const Point2 place = bricks.at(in(-1, 75), kRow * static_cast<double>(random_() % 9) + in(-0.06, 0.06));
      const GridPoint q = bare.grid.quantise({place.x, place.y, 0});
      const double found = *roofs.height_at({q.x, q.y}) - *ground.height_at({q.x, q.y});
      const auto [low, high] = bricks.about(bare.grid.position(q.x, q.y));
      above = std::max(above, found - high), below = std::max(below, low - found);
      too_high += found > high + kRounded, too_low += found < low - kRounded;
    }
    EXPECT_EQ(too_high, 0) << "by up to " << above << " m";
    // The terrain's own vertices in the wall between two bricks lie on the ground. Few places are beside one.
    if (turn == 0) {
      EXPECT_LE(too_low, 20) << "by up to " << below << " m";
    }
  }
}

/// A row of posts lies within the front wall of both blocks: on the high one's eaves 12 m west of their border, and on
/// the low one's foot 12 m east of it.
TEST_F(WallStrip, IsCutWhereAnEdgeOfTheTerrainRunsAlongIt) {
  const auto block = [](double west, double east, double height) {
    const auto front = [](double x) { return 199955.025 - 0.002 * (x - 300180); };
    test::LineFeature f = test::box(west, 199930, east, 199950, height);
    f.vertices[2].y = front(east), f.vertices[3].y = front(west);
    return f;
  };
  build(30, {block(300160, 300180, 11), block(300180, 300200, 2)});
  const Tin bare = surface(ThemeChoice::none()), raised = surface(ThemeChoice::all());
  const TerrainHeights ground(bare), roofs(raised);
  for (double x = 300180.2; x < 300192; x += 0.25)
    for (double y = 199954.9; y < 199955.06; y += 0.01) {
      const GridPoint q = bare.grid.quantise({x, y, 0});
      ASSERT_LE(*roofs.height_at({q.x, q.y}) - *ground.height_at({q.x, q.y}), 2 + kRounded) << x << ' ' << y;
    }
}

}  // namespace
}  // namespace itin
