// The meaning of a viewshed request: cells, values, fields of view, several observers, ground without data, wrong
// calls.
#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <limits>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <viewshed/result_files.hpp>
#include <viewshed/viewshed.hpp>

#include "support/impatient.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"
#include "support/viewshed_of.hpp"

namespace itin::viewshed {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using test::kCorner;

Tin plane(std::int32_t side = 41) {
  return test::lattice_tin(side, side, 10, [](std::int32_t, std::int32_t) { return 100.0; });
}

/// A wall 20 m high and 10 m thick at the foot, from south to north through the middle.
Tin walled() {
  return test::lattice_tin(41, 41, 10, [](std::int32_t c, std::int32_t) { return c == 20 ? 120.0 : 100.0; });
}

Request look(double dx, double dy, double height = 2) {
  Request request;
  request.observers = {{"mast", {kCorner.x + dx, kCorner.y + dy}, height}};
  request.cell_size = 10;
  return request;
}

using test::run;

Verdict at(const Result& result, double dx, double dy) {
  return result.visible[result.grid.index(result.grid.cell_at({kCorner.x + dx, kCorner.y + dy}).value())];
}

std::string refusal(const Tin& tin, const Request& request) {
  try {
    run(tin, request);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Viewshed, EverythingIsSeenOnAPlane) {
  const Result result = run(plane(), look(205, 205));
  EXPECT_EQ(result.grid.columns(), 40);
  EXPECT_EQ(result.grid.rows(), 40);
  EXPECT_THAT(result.visible, Each(Verdict::kVisible));
  EXPECT_EQ(result.cells.visible, 1600U);
  EXPECT_EQ(result.cells.hidden + result.cells.outside, 0U);
  EXPECT_EQ(result.ground_m, std::vector<double>{100.0});
  EXPECT_THAT(result.warnings, IsEmpty());
}

TEST(Viewshed, GrazingRaysSee) {
  // With both ends on the plane itself every sight line lies in it.
  Request request = look(205, 205, 0);
  request.earth = Earth::flat();
  EXPECT_THAT(run(plane(), request).visible, Each(Verdict::kVisible));
}

TEST(Viewshed, OnACurvedPlaneTheGroundItselfHides) {
  const Tin tin = test::lattice_tin(41, 41, 1000, [](std::int32_t, std::int32_t) { return 100.0; });
  Request request = look(20500, 20500, 2);
  request.cell_size = 1000;
  // The horizon of an eye 2 m up lies at sqrt(2 R 2 / (1 - k)) = 5.4 km.
  const Result result = run(tin, request);
  EXPECT_EQ(at(result, 25500, 20500), Verdict::kVisible);
  EXPECT_EQ(at(result, 26500, 20500), Verdict::kHidden);
}

TEST(Viewshed, AWallHides) {
  const Result result = run(walled(), look(105, 205));
  EXPECT_EQ(at(result, 15, 205), Verdict::kVisible);
  EXPECT_EQ(at(result, 185, 205), Verdict::kVisible);
  EXPECT_EQ(at(result, 225, 205), Verdict::kHidden);
  EXPECT_EQ(at(result, 395, 35), Verdict::kHidden);
}

TEST(Viewshed, AnObserverAMillionMetresUpSeesEverything) {
  const Tin tin = test::fractal_tin(65, 50, 400, 0.5, 7);
  Request request;
  request.observers = {{"satellite", {kCorner.x + 1600, kCorner.y + 1600}, 1000000}};
  request.cell_size = 10;
  request.earth = Earth::flat();
  EXPECT_THAT(run(tin, request).visible, Each(Verdict::kVisible));
}

TEST(Viewshed, AbsoluteHeightsAreElevations) {
  Request request = look(105, 205);
  request.observers[0].height = 125;
  request.observers[0].absolute = true;
  request.target_height = 125;
  request.target_absolute = true;
  EXPECT_THAT(run(walled(), request).visible, Each(Verdict::kVisible));
  request.target_height = 99;  // below the ground
  EXPECT_THAT(run(walled(), request).visible, Each(Verdict::kHidden));
  request.observers[0].height = 90;
  EXPECT_THAT(refusal(walled(), request), HasSubstr("below the ground"));
}

TEST(Viewshed, RadiiBoundTheFieldOfView) {
  Request request = look(205, 205);
  request.radius = 100;
  request.min_radius = 30;
  const Result result = run(plane(), request);
  EXPECT_EQ(result.grid.columns(), 21);  // 100 to 310, edges on multiples of the cell size
  for (std::int64_t row = 0; row < result.grid.rows(); ++row) {
    for (std::int64_t column = 0; column < result.grid.columns(); ++column) {
      const Point2 c = result.grid.centre(column, row);
      const double d = std::hypot(c.x - request.observers[0].position.x, c.y - request.observers[0].position.y);
      EXPECT_EQ(result.visible[result.grid.index({column, row})],
                d >= 30 && d <= 100 ? Verdict::kVisible : Verdict::kOutside)
          << d;
    }
  }
}

TEST(Viewshed, AzimuthsMayPassThroughNorth) {
  Request request = look(200, 200);
  request.azimuth = AngleRange{315, 45};
  const Result result = run(plane(), request);
  EXPECT_EQ(at(result, 205, 385), Verdict::kVisible);
  EXPECT_EQ(at(result, 385, 205), Verdict::kOutside);
  EXPECT_EQ(at(result, 205, 15), Verdict::kOutside);
  request.azimuth = AngleRange{0, 360};
  EXPECT_THAT(run(plane(), request).visible, Each(Verdict::kVisible));
}

TEST(Viewshed, ElevationsBoundTheFieldOfView) {
  Request request = look(200, 200, 10);
  request.earth = Earth::flat();
  request.elevation = AngleRange{-90, -45};  // within 10 m of the foot
  const Result result = run(plane(), request);
  EXPECT_EQ(at(result, 205, 205), Verdict::kVisible);
  EXPECT_EQ(at(result, 225, 205), Verdict::kOutside);
}

TEST(Viewshed, SeveralObserversSeeWhatAnySees) {
  Request request = look(105, 205);
  request.observers.push_back({"east", {kCorner.x + 305, kCorner.y + 205}, 2});
  const Result both = run(walled(), request);
  EXPECT_EQ(at(both, 15, 205), Verdict::kVisible);
  EXPECT_EQ(at(both, 395, 205), Verdict::kVisible);
  request.mode = Mode::kCount;
  request.radius = 150;
  const Result count = run(walled(), request);
  const std::vector<std::uint16_t>& counts = count.get<Counts>().count;
  const auto seen_by = [&](double dx, double dy) {
    return counts[count.grid.index(count.grid.cell_at({kCorner.x + dx, kCorner.y + dy}).value())];
  };
  EXPECT_EQ(seen_by(105, 205), 1);
  EXPECT_EQ(seen_by(225, 205), 1);
  EXPECT_EQ(seen_by(245, 345), kCountOutside);
  for (std::size_t i = 0; i < counts.size(); ++i)
    EXPECT_EQ(count.visible[i], counts[i] == kCountOutside ? Verdict::kOutside
                                : counts[i] > 0            ? Verdict::kVisible
                                                           : Verdict::kHidden);
  std::uint64_t counted = 0;
  for (const std::uint16_t n : counts) counted += n != 0 && n != kCountOutside;
  EXPECT_EQ(counted, count.cells.visible);
  request.radius.reset();
  request.observers[0].height = request.observers[1].height = 100;
  EXPECT_EQ(run(walled(), request).get<Counts>().count[0], 2);
}

TEST(Viewshed, SwappingTheEndsKeepsTheVerdict) {
  const Tin tin = test::fractal_tin(33, 50, 150, 0.55, 3);
  const RasterGrid grid({kCorner.x + 100, kCorner.y + 1500}, 280, 280, 5, 5);
  NoProgress progress;
  std::vector<std::vector<Verdict>> seen;
  for (std::size_t i = 0; i < grid.cell_count(); ++i) {
    Request request;
    request.observers = {{"o", grid.centre(static_cast<std::int64_t>(i) % 5, static_cast<std::int64_t>(i) / 5), 3}};
    request.target_height = 3;
    request.grid = grid;
    seen.push_back(run(tin, request).visible);
  }
  int hidden = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_EQ(seen[i][j], seen[j][i]) << i << " and " << j;
      hidden += seen[i][j] == Verdict::kHidden;
    }
  }
  EXPECT_GT(hidden, 20);
}

TEST(Viewshed, TheNumberOfThreadsDoesNotShow) {
  const Tin tin = test::fractal_tin(129, 50, 300, 0.5, 5);
  Request request = look(3123, 2987, 10);
  request.observers.push_back({"b", {kCorner.x + 900, kCorner.y + 5000}, 5});
  request.cell_size = 20;
  request.mode = Mode::kCount;
  set_thread_count(1);
  const Result one = run(tin, request);
  set_thread_count(0);
  const Result all = run(tin, request);
  EXPECT_EQ(one.get<Counts>().count, all.get<Counts>().count);
  EXPECT_EQ(one.statistics.lines, all.statistics.lines);
}

/// A strip without data, from south to north, 200 to 230 m from the western edge.
Tin parted() {
  return test::lattice_tin(41, 41, 10, [](std::int32_t c, std::int32_t) {
    return c == 21 || c == 22 ? std::numeric_limits<double>::quiet_NaN() : 100.0;
  });
}

TEST(Viewshed, GroundWithoutDataIsUnknownClearOrBlocks) {
  Request request = look(105, 205, 5);
  const Result unknown = run(parted(), request);
  EXPECT_EQ(at(unknown, 395, 205), Verdict::kUndecided);
  EXPECT_EQ(at(unknown, 215, 205), Verdict::kOutside);
  EXPECT_EQ(at(unknown, 195, 205), Verdict::kVisible);
  EXPECT_TRUE(unknown.crosses_voids);
  EXPECT_THAT(unknown.warnings, IsEmpty());  // the cells say so themselves

  request.nodata = NoData::kClear;
  const Result clear = run(parted(), request);
  EXPECT_EQ(at(clear, 395, 205), Verdict::kVisible);
  EXPECT_THAT(clear.warnings, IsEmpty());

  request.nodata = NoData::kBlock;
  const Result block = run(parted(), request);
  for (std::size_t i = 0; i < unknown.visible.size(); ++i) {
    const bool open = clear.visible[i] != block.visible[i];
    ASSERT_EQ(unknown.visible[i], open ? Verdict::kUndecided : clear.visible[i]) << i;
  }
  EXPECT_EQ(at(block, 395, 205), Verdict::kHidden);
  EXPECT_EQ(at(block, 235, 35), Verdict::kHidden);
  EXPECT_EQ(at(block, 195, 205), Verdict::kVisible);
  EXPECT_EQ(at(block, 5, 395), Verdict::kVisible);
  EXPECT_THAT(block.warnings, IsEmpty());
  request.observers[0].height = 100000;
  EXPECT_EQ(at(run(parted(), request), 395, 205), Verdict::kHidden);
}

TEST(Viewshed, IsAsUndecidedInEveryMode) {
  Request request = look(105, 205, 5);
  request.vertical_error = {1, 0};
  const Result expected = run(parted(), request);
  EXPECT_GT(expected.cells.undecided, 0U);
  for (const Mode mode :
       {Mode::kCount, Mode::kWhich, Mode::kAngle, Mode::kNearest, Mode::kBlocker, Mode::kHeight, Mode::kProbability}) {
    SCOPED_TRACE(static_cast<int>(mode));
    request.mode = mode;
    const Result result = run(parted(), request);
    EXPECT_EQ(result.visible, expected.visible);
    EXPECT_TRUE(result.warnings.empty());
  }
}

TEST(Viewshed, ObserversAreCountedAndNamedWhereTheyCertainlySee) {
  Request request = look(105, 205, 5);
  request.observers.push_back({"north", {kCorner.x + 155, kCorner.y + 305}, 5});
  const Result visible = run(parted(), request);
  EXPECT_GT(visible.cells.undecided, 0U);
  const auto in = [&](Mode mode, NoData rule) {
    request.mode = mode, request.nodata = rule;
    return run(parted(), request);
  };
  const Result counted = in(Mode::kCount, NoData::kUnknown), named = in(Mode::kWhich, NoData::kUnknown),
               nearest = in(Mode::kNearest, NoData::kUnknown), angle = in(Mode::kAngle, NoData::kUnknown);
  EXPECT_EQ(counted.get<Counts>().count, in(Mode::kCount, NoData::kBlock).get<Counts>().count);
  EXPECT_EQ(named.get<ObserverSets>().words, in(Mode::kWhich, NoData::kBlock).get<ObserverSets>().words);
  EXPECT_EQ(nearest.get<NearestObservers>().number, in(Mode::kNearest, NoData::kBlock).get<NearestObservers>().number);
  EXPECT_NE(counted.get<Counts>().count, in(Mode::kCount, NoData::kClear).get<Counts>().count);
  for (const Result* r : {&counted, &named, &nearest, &angle}) {
    EXPECT_EQ(r->visible, visible.visible);
    EXPECT_THAT(r->warnings, IsEmpty());
  }
  for (std::size_t i = 0; i < visible.visible.size(); ++i)
    ASSERT_EQ(std::isnan(angle.get<Angles>().angle_deg[i]), visible.visible[i] != Verdict::kVisible) << i;
}

TEST(Viewshed, TheEdgeOfTheDataHidesNothingOnThisSide) {
  // Observers on the boundary look along it.
  for (const auto& [dx, dy] : {std::pair{0.0, 0.0}, {0.0, 200.0}, {400.0, 400.0}, {200.0, 0.0}}) {
    Request request = look(dx, dy);
    request.nodata = NoData::kBlock;
    EXPECT_THAT(run(plane(), request).visible, Each(Verdict::kVisible)) << dx << " " << dy;
  }
}

TEST(Viewshed, PostsAtTheEdgeOfTheDataBelongToIt) {
  // A national grid's numbers at 1 mm: metres and grid units do not convert without rounding.
  const Tin tin =
      test::lattice_tin(21, 21, 50, [](std::int32_t, std::int32_t) { return 10.0; }, 0.001, {531234.567, 4181234.567});
  Request request;
  const Box box = tin.bounds();
  request.grid = RasterGrid({box.xmin - 25, box.ymax + 25}, 50, 50, 21, 21);
  for (std::uint32_t v = 0; v < tin.vertices.size(); v += 7) {
    const Point3 p = tin.point(v);
    request.observers = {{"post", {p.x, p.y}, 2}};
    ASSERT_THAT(run(tin, request).visible, Each(Verdict::kVisible)) << p.x << "," << p.y;
  }
}

TEST(Viewshed, VoidsOutOfReachAreNotMentioned) {
  Request request = look(105, 205);
  request.radius = 90;
  EXPECT_FALSE(run(parted(), request).crosses_voids);
  EXPECT_FALSE(run(plane(), look(0, 0)).crosses_voids);
}

TEST(Viewshed, CellsOutsideTheDataHaveNone) {
  Request request = look(205, 205);
  request.cell_size.reset();
  request.grid = RasterGrid({kCorner.x - 100, kCorner.y + 500}, 10, 20, 60, 30);
  const Result result = run(plane(), request);
  EXPECT_EQ(result.grid, *request.grid);
  EXPECT_EQ(at(result, -50, 205), Verdict::kOutside);
  EXPECT_EQ(at(result, 5, 5), Verdict::kVisible);
  EXPECT_EQ(result.cells.visible, 40U * 20U);
}

TEST(Viewshed, ADefaultCellSizeIsChosen) {
  Request request = look(205, 205);
  request.cell_size.reset();
  const Result result = run(plane(), request);
  EXPECT_DOUBLE_EQ(result.grid.cell_width(), 0.2);
}

TEST(Viewshed, WrongCallsAreRefused) {
  const Tin tin = plane();
  Request request = look(-5, 205);
  EXPECT_THAT(refusal(tin, request), HasSubstr("observer mast at 299995,200205: there is no data there"));
  EXPECT_THAT(refusal(parted(), look(215, 205)), HasSubstr("no data"));
  const auto refused = [&](const auto& change) {
    Request wrong = look(205, 205);
    change(wrong);
    return refusal(tin, wrong);
  };
  EXPECT_THAT(refused([](Request& r) { r.radius = 0; }), HasSubstr("radius 0"));
  EXPECT_THAT(refused([](Request& r) { r.radius = -3; }), HasSubstr("radius -3"));
  EXPECT_THAT(refused([](Request& r) { r.radius = 5; }), HasSubstr("larger than the radius"));
  EXPECT_THAT(refused([](Request& r) { r.cell_size = 0; }), HasSubstr("cell size 0"));
  EXPECT_THAT(refused([](Request& r) { r.radius = 50, r.min_radius = 60; }), HasSubstr("exceeds"));
  EXPECT_THAT(refused([](Request& r) { r.observers.clear(); }), HasSubstr("no observer"));
  EXPECT_THAT(refused([](Request& r) { r.observers[0].height = -1; }), HasSubstr("below the ground"));
  EXPECT_THAT(refused([](Request& r) { r.target_height = -1; }), HasSubstr("target height"));
  EXPECT_THAT(refused([](Request& r) { r.elevation = AngleRange{10, -10}; }), HasSubstr("elevation"));
  EXPECT_THAT(refused([](Request& r) { r.earth.radius = 0; }), HasSubstr("radius"));
  EXPECT_THAT(refused([](Request& r) { r.grid = RasterGrid({0, 0}, 1, 1, 1, 1); }), HasSubstr("both"));
}

TEST(Viewshed, CanBeCancelled) {
  test::Impatient stop(0);
  EXPECT_THROW(compute(plane(), look(205, 205), stop), Cancelled);
}

TEST(Viewshed, LeavesNoFileWhenItsWriterIsCancelled) {
  const test::TemporaryDirectory directory;
  Request request = look(205, 205);
  const Result cells = run(plane(), request);
  EXPECT_THROW(write_geotiff(directory.file("a.tif"), cells, {}, test::Impatient(0)), Cancelled);
  request.mode = Mode::kCount;
  const Result counts = run(plane(), request);
  EXPECT_THROW(write_geotiff(directory.file("b.tif"), counts, {}, test::Impatient(0)), Cancelled);
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
  write_geotiff(directory.file("a.tif"), cells, {});
  EXPECT_TRUE(std::filesystem::exists(directory.file("a.tif")));
}

}  // namespace
}  // namespace itin::viewshed
