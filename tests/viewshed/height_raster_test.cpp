// Viewsheds over a canopy raster against sight lines that are followed in small steps over the prisms of its cells.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/viewshed.hpp>

#include "features/mesh/terrain_heights.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

/// Metres: how far walls stand within their cells' edges, with what rounding adds, and how far heights are rounded.
constexpr double kWall = 0.08, kRounded = 0.05;
constexpr double kStepOfLine = 0.04;

constexpr int kColumns = 40, kRows = 36;
constexpr double kWest = 300061, kNorth = 199931, kCell = 3;

class Prisms {
 public:
  Prisms(const TerrainHeights& ground, std::vector<double> heights) : ground_(ground), heights_(std::move(heights)) {}

  double ground(Point2 p) const {
    const GridPoint q = ground_.grid().quantise({p.x, p.y, 0});
    return *ground_.height_at({q.x, q.y});
  }
  /// The least and the greatest height above the ground of the cells within reach.
  std::pair<double, double> about(Point2 p) const {
    double low = 1e9, high = 0;
    for (const double dx : {-kWall, 0.0, kWall})
      for (const double dy : {-kWall, 0.0, kWall}) {
        const double h = at({p.x + dx, p.y + dy});
        low = std::min(low, h), high = std::max(high, h);
      }
    return {low, high};
  }

 private:
  double at(Point2 p) const {
    const int column = static_cast<int>(std::floor((p.x - kWest) / kCell)),
              row = static_cast<int>(std::floor((kNorth - p.y) / kCell));
    if (column < 0 || row < 0 || column >= kColumns || row >= kRows) return 0;
    return heights_[static_cast<std::size_t>(row * kColumns + column)];
  }

  const TerrainHeights& ground_;
  std::vector<double> heights_;
};

enum class Seen { yes, no, open };

Seen followed(const Prisms& prisms, Point3 eye, Point3 target) {
  const double length = std::hypot(target.x - eye.x, target.y - eye.y);
  bool clear = true;
  for (double d = kStepOfLine; d < length - kStepOfLine; d += kStepOfLine) {
    const double t = d / length, z = eye.z + t * (target.z - eye.z);
    const Point2 p{eye.x + t * (target.x - eye.x), eye.y + t * (target.y - eye.y)};
    const double ground = prisms.ground(p);
    const auto [low, high] = prisms.about(p);
    if (ground + low > z + kRounded) return Seen::no;
    clear = clear && ground + high < z - kRounded;
  }
  return clear ? Seen::yes : Seen::open;
}

TEST(HeightRasterViewshed, IsThatOfThePrismsOfItsCells) {
  std::mt19937 random(test::seed());
  const auto in = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 1000000) / 1e6;
  };
  const test::TemporaryDirectory directory;
  const double phase = in(0, 6);
  test::write_raster(directory.file("hills.tif"), {300000, 200000, 12, 24, 24, 27700},
                     [&](int c, int r) { return 60 + 7 * std::sin(c / 4.0 + phase) + 5 * std::cos(r / 3.0); });
  std::vector<double> heights;
  for (int i = 0; i < kColumns * kRows; ++i)
    heights.push_back(random() % 6 == 0 ? 2.0 * static_cast<double>(random() % 6) : 0);
  test::write_raster(directory.file("canopy.tif"), {kWest, kNorth, kCell, kColumns, kRows, 27700},
                     [&](int c, int r) { return heights[static_cast<std::size_t>(r * kColumns + c)] + in(-0.9, 0.9); });
  NoProgress progress;
  ImportOptions options;
  options.sources = {directory.file("hills.tif")};
  import_terrain(directory.file("s.itin"), options, progress);
  options.sources = {directory.file("canopy.tif")};
  options.kind = ThemeKind::Vegetation;
  options.height_threshold = 1;
  import_lines(directory.file("s.itin"), options, progress);

  const Store store(directory.file("s.itin"));
  const Tin tin = triangulate(store, Window::all(), Detail::tolerance(0), progress, ThemeChoice::none());
  const TerrainHeights ground(tin);
  const Prisms prisms(ground, heights);
  int compared = 0, open = 0, seen = 0;
  for (int turn = 0; turn < 3; ++turn) {
    viewshed::Request request;
    request.observers = {{"o", {in(300070, 300170), in(199840, 199920)}, in(1.7, 14)}};
    request.target_height = 1.5;
    request.cell_size = 4;
    request.themes = ThemeChoice::all();
    const Point2 at = request.observers[0].position;
    const Point3 eye{at.x, at.y, prisms.ground(at) + request.observers[0].height};
    const viewshed::Result result = viewshed::compute(store, request, progress);
    for (std::int64_t row = 0; row < result.grid.rows(); ++row)
      for (std::int64_t column = 0; column < result.grid.columns(); ++column) {
        const auto verdict = result.visible[result.grid.index({column, row})];
        if (verdict != viewshed::Verdict::kVisible && verdict != viewshed::Verdict::kHidden) continue;
        const Point2 p = result.grid.centre(column, row);
        // A step off the line is some height off; targets at walls are left to the tests of grazing lines.
        const Seen expected = followed(prisms, eye, {p.x, p.y, prisms.ground(p) + request.target_height});
        if (expected == Seen::open) {
          ++open;
          continue;
        }
        ++compared;
        seen += expected == Seen::yes ? 1 : 0;
        EXPECT_EQ(verdict == viewshed::Verdict::kVisible, expected == Seen::yes) << p.x << ' ' << p.y;
      }
  }
  std::cout << compared << " cells compared, " << seen << " of them seen; " << open << " too near to a prism\n";
  EXPECT_GT(compared, 5000);
  EXPECT_GT(seen, 100);
  EXPECT_LT(open, compared / 4);
}

}  // namespace
}  // namespace itin
