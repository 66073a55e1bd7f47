// The triangle that first hides a cell, against every triangle, and against exact lines of sight that end just before
// and after it.
#include <cmath>
#include <gmock/gmock.h>

#include <gtest/gtest.h>

#include <viewshed/viewshed.hpp>

#include "line/sight_line.hpp"
#include "modes/feature_names.hpp"
#include "modes/lines/first_blocker.hpp"
#include "support/exact_line_of_sight.hpp"
#include "support/hills_and_town.hpp"
#include "support/impatient.hpp"
#include "support/real_terrain.hpp"
#include "support/terrain_tin.hpp"
#include "support/viewshed_of.hpp"

namespace itin::viewshed {
namespace {

using test::kCorner;

using test::run;

void expect_first(const Tin& tin, Point2 from, double cell, const Earth& earth) {
  Request request;
  request.mode = Mode::kBlocker;
  request.observers = {{"", from, 2}};
  request.target_height = 1;
  request.cell_size = cell;
  request.earth = earth;
  const Result result = run(tin, request);
  const test::ExactLineOfSight exact(tin, earth);
  const FirstBlocker blockers(std::make_shared<const HeightPyramid>(tin), earth);
  const double unit = tin.grid.resolution, drop = earth.drop_coefficient() * unit;
  const Point3 eye{from.x, from.y, *exact.height(from) + 2};
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < result.get<Blockers>().triangle.size(); ++i) {
    ASSERT_EQ(result.get<Blockers>().triangle[i] != kNoBlocker, result.visible[i] == Verdict::kHidden);
    if (result.visible[i] != Verdict::kHidden) continue;
    ++hidden;
    EXPECT_EQ(result.get<Blockers>().theme[i], 0U);
    const auto columns = result.grid.columns();
    const Point2 c = result.grid.centre(static_cast<std::int64_t>(i) % columns, static_cast<std::int64_t>(i) / columns);
    const Point3 target{c.x, c.y, *exact.height(c) + 1};
    const auto units = [&](const Point3& p) {
      return Point3{(p.x - tin.grid.origin.x) / unit, (p.y - tin.grid.origin.y) / unit, p.z / unit};
    };
    const SightLine line(units(eye), units(target), drop, kGrazing / unit);
    const auto hidden_from = [&](std::uint32_t t) {
      const auto& [u, v, w] = tin.triangles[t];
      return line.hidden_from(tin.vertices[u], tin.vertices[v], tin.vertices[w]);
    };
    double least = 2;
    for (std::uint32_t t = 0; t < tin.triangles.size(); ++t)
      if (const auto at = hidden_from(t)) least = std::min(least, *at);
    const auto& [u, v, w] = result.get<Blockers>().triangles[result.get<Blockers>().triangle[i]].corners;
    const auto found = line.hidden_from(u, v, w);
    ASSERT_TRUE(found) << "triangle " << result.get<Blockers>().triangle[i] << " hides nothing";
    ASSERT_NEAR(*found, least, 1e-9);
    // The line is clear up to that place, and not beyond.
    const double length = std::hypot(target.x - eye.x, target.y - eye.y);
    const auto point = [&](double s) {
      return Point3{eye.x + s * (target.x - eye.x), eye.y + s * (target.y - eye.y),
                    eye.z + s * (target.z - eye.z) - earth.drop(length) * s * (1 - s)};
    };
    EXPECT_GE(exact.clearance(eye, point(*found)), -2e-6);
    EXPECT_LT(exact.clearance(eye, target), -0.5e-6);
  }
  EXPECT_GT(hidden, result.get<Blockers>().triangle.size() / 20);
}

TEST(BlockerMode, IsTheFirstTriangleThatHides) {
  const Tin tin = test::fractal_tin(33, 50, 60, 0.55, 5);
  expect_first(tin, {kCorner.x + 803, kCorner.y + 798}, 37, {});
  expect_first(tin, {kCorner.x + 800, kCorner.y + 800}, 40, Earth::flat());  // on a vertex, along edges
}

TEST(BlockerMode, IsTheFirstTriangleOverTheHorizon) {
  // Posts 2 km apart: triangles hide by their bulge, in their middle.
  expect_first(test::fractal_tin(17, 2000, 20, 0.5, 9), {kCorner.x + 16100, kCorner.y + 15900}, 900, {});
}

TEST(BlockerMode, IsTheFirstTriangleOnRealTerrain) {
  const auto tin = test::big_tujunga(300, 300, 40);
  if (!tin) GTEST_SKIP() << "needs " << test::big_tujunga_path();
  const Box box = tin->bounds();
  expect_first(*tin, {box.xmin + 0.47 * box.width(), box.ymin + 0.55 * box.height()}, 31, {});
}

TEST(BlockerMode, NamesTheThemeAndMissingGround) {
  // A wall of a theme, then a gap; both hide what is behind them.
  Tin tin = test::lattice_tin(41, 41, 10, [](std::int32_t c, std::int32_t) {
    return c > 28 && c < 32 ? std::nan("") : c == 20 ? 120.0 : 100.0;
  });
  tin.raised_theme.resize(tin.vertices.size());
  for (std::size_t v = 0; v < tin.vertices.size(); ++v)
    tin.raised_theme[v] = tin.vertices[v].z * tin.grid.resolution > 110 ? 3 : 0;
  Request request;
  request.mode = Mode::kBlocker;
  request.observers = {{"", {kCorner.x + 105, kCorner.y + 205}, 2}};
  request.cell_size = 10;
  request.nodata = NoData::kBlock;
  const auto theme = [&](const Result& result, double dx) {
    return result.get<Blockers>()
        .theme[result.grid.index(result.grid.cell_at({kCorner.x + dx, kCorner.y + 205}).value())];
  };
  const Result low = run(tin, request);
  EXPECT_EQ(theme(low, 155), kNoBlocker);
  EXPECT_EQ(theme(low, 255), 3U);
  EXPECT_EQ(theme(low, 355), 3U);
  request.observers[0].height = 200;
  const Result high = run(tin, request);
  EXPECT_EQ(theme(high, 255), kNoBlocker);
  EXPECT_EQ(theme(high, 355), kMissingGround);
  // From the other side the gap comes before the wall, which alone is known to hide what lies behind both.
  request.observers = {{"", {kCorner.x + 385, kCorner.y + 205}, 2}};
  EXPECT_EQ(theme(run(tin, request), 105), kMissingGround);
  request.nodata = NoData::kUnknown;
  const Result open = run(tin, request);
  EXPECT_EQ(theme(open, 105), kMissingGround);
  EXPECT_EQ(open.visible[open.grid.index(open.grid.cell_at({kCorner.x + 105, kCorner.y + 205}).value())],
            Verdict::kHidden);
  EXPECT_EQ(theme(open, 255), kNoBlocker);
  EXPECT_EQ(open.visible[open.grid.index(open.grid.cell_at({kCorner.x + 255, kCorner.y + 205}).value())],
            Verdict::kUndecided);
  request.nodata = NoData::kClear;
  EXPECT_EQ(theme(run(tin, request), 105), 3U);
}

TEST(BlockerMode, IsCancelledWhileItNamesFeatures) {
  const test::HillsAndTown stores;
  const Store store(stores.town());
  Request request = test::HillsAndTown::over_town();
  request.mode = Mode::kBlocker;
  NoProgress progress;
  Result result = compute(store, request, progress);
  ASSERT_NE(result.get<Blockers>().feature,
            std::vector<std::uint32_t>(result.get<Blockers>().triangle.size(), kNoBlocker));
  EXPECT_THROW(name_features(store, result, test::Impatient(0)), Cancelled);
}

TEST(BlockerMode, OfSeveralObserversThatOfTheNearest) {
  Tin tin =
      test::lattice_tin(41, 41, 10, [](std::int32_t c, std::int32_t) { return c == 20 || c == 30 ? 120.0 : 100.0; });
  tin.raised_theme.resize(tin.vertices.size());
  for (std::size_t v = 0; v < tin.vertices.size(); ++v)
    if (tin.vertices[v].z * tin.grid.resolution > 110) tin.raised_theme[v] = tin.vertices[v].x > 25000 ? 2 : 1;
  Request request;
  request.mode = Mode::kBlocker;
  request.observers = {{"far", {kCorner.x + 55, kCorner.y + 205}, 2}, {"near", {kCorner.x + 385, kCorner.y + 205}, 2}};
  request.cell_size = 10;
  const Result result = run(tin, request);
  const auto theme = [&](double dx) {
    return result.get<Blockers>()
        .theme[result.grid.index(result.grid.cell_at({kCorner.x + dx, kCorner.y + 205}).value())];
  };
  EXPECT_EQ(theme(105), kNoBlocker);
  EXPECT_EQ(theme(255), 2U);  // nearer to the eastern one, behind the eastern wall
  EXPECT_EQ(theme(215), 1U);
}

}  // namespace
}  // namespace itin::viewshed
