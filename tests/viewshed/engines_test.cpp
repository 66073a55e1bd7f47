// The two engines, the sweep and rays, decide every sight line alike.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/viewshed.hpp>

#include "bounds/boundary.hpp"
#include "bounds/surface_heights.hpp"
#include "support/alexandria.hpp"
#include "support/delaunay_tin.hpp"
#include "support/full_detail.hpp"
#include "support/same_result.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

const std::vector<Mode> kModesOfRays{Mode::kVisible, Mode::kCount,   Mode::kWhich,      Mode::kAngle,
                                     Mode::kNearest, Mode::kBlocker, Mode::kProbability};
/// For large cases: the others ask the engines nothing else.
const std::vector<Mode> kFewModes{Mode::kWhich, Mode::kNearest};

class Engines : public testing::Test {
 protected:
  /// The viewsheds of a request by both engines; `compute_by` makes one.
  template <class Compute>
  void expect_same_by_both(Request request, const std::vector<Mode>& modes, const Compute& compute_by) {
    request.vertical_error = {0.5, 30};
    for (const Mode mode : modes) {
      SCOPED_TRACE("mode " + std::to_string(static_cast<int>(mode)));
      request.mode = mode;
      request.engine = Engine::kSweep;
      const Result swept = compute_by(request);
      request.engine = Engine::kRays;
      const Result cast = compute_by(request);
      test::expect_same_result(swept, cast);
      visible_ += swept.cells.visible, hidden_ += swept.cells.hidden;
    }
  }

  /// Observers of all kinds: anywhere, on vertices, on edges, at elevations, with height 0.
  Request request_over(const Tin& tin, std::size_t observers) {
    Request request;
    const Box box = tin.bounds();
    std::uniform_real_distribution<double> along(0.02, 0.98), height(0, 30);
    while (request.observers.size() < observers) {
      Observer o{std::to_string(request.observers.size()),
                 {box.xmin + along(random_) * box.width(), box.ymin + along(random_) * box.height()},
                 height(random_)};
      const Triangle& t = tin.triangles[random_() % tin.triangles.size()];
      const Point3 a = tin.point(t[0]), b = tin.point(t[1]);
      if (request.observers.size() % 3 == 1) o.position = {a.x, a.y}, o.height = 0;
      if (request.observers.size() % 3 == 2) o.position = {(a.x + b.x) / 2, (a.y + b.y) / 2}, o.height = 1.5;
      request.observers.push_back(o);
    }
    request.cell_size = std::max(box.width(), box.height()) / 90;
    return request;
  }

  std::mt19937 random_{test::seed()};
  NoProgress progress_;
  std::uint64_t visible_ = 0, hidden_ = 0;
};

TEST_F(Engines, AgreeOverRandomTins) {
  for (int round = 0; round < 12; ++round) {
    SCOPED_TRACE(round);
    const Tin tin = test::random_tin(random_, 400, round % 2 == 0 ? 0.15 : 0);
    Request request = request_over(tin, 1 + static_cast<std::size_t>(round % 4));
    std::erase_if(request.observers, [&](const Observer& o) { return !height_on(tin, o.position); });
    if (request.observers.empty()) continue;
    request.target_height = round % 3;
    request.nodata = round % 4 == 0 ? NoData::kUnknown : round % 4 == 1 ? NoData::kBlock : NoData::kClear;
    expect_same_by_both(request, kModesOfRays, [&](const Request& r) { return compute(tin, r, progress_); });
  }
  EXPECT_GT(visible_, 200U);
  EXPECT_GT(hidden_, 200U);
}

/// Every line between places on a plane grazes it from end to end.
TEST_F(Engines, AgreeWhereEveryLineGrazes) {
  for (const bool curved : {false, true}) {
    for (const double slope : {0.0, 0.25}) {
      const Tin tin = test::lattice_tin(60, 60, 25, [&](int c, int r) { return 100 + slope * 25 * c + 0 * r; });
      Request request = request_over(tin, 5);
      for (Observer& o : request.observers) o.height = 0;
      request.earth.curvature = curved;
      expect_same_by_both(request, kFewModes, [&](const Request& r) { return compute(tin, r, progress_); });
    }
  }
}

/// Ridges one step wide: lines run along their crests and just over them.
TEST_F(Engines, AgreeOverWalls) {
  const Tin tin = test::lattice_tin(70, 70, 10, [](int c, int r) { return c % 9 == 4 || r % 13 == 6 ? 40.0 : 10.0; });
  Request request = request_over(tin, 6);
  request.observers[0] = {"level with the crests", {test::kCorner.x + 45, test::kCorner.y + 300}, 30};
  request.target_height = 29.5;
  expect_same_by_both(request, kFewModes, [&](const Request& r) { return compute(tin, r, progress_); });
  request.observers = {{"between walls", {test::kCorner.x + 95, test::kCorner.y + 95}, 1.5}};
  expect_same_by_both(request, kFewModes, [&](const Request& r) { return compute(tin, r, progress_); });
  EXPECT_GT(visible_, 200U);
  EXPECT_GT(hidden_, 200U);
}

/// Posts on and beside lines that run along where the ground ends: along sides at all angles and past its corners.
TEST_F(Engines, AgreeAlongTheRim) {
  const auto gap = [](int c, int r) { return c > 11 && c < 17 && r > 5 && r < 10; };
  for (int round = 0; round < 120; ++round) {
    SCOPED_TRACE(round);
    Tin tin = test::lattice_tin(30, round % 3 == 0 ? 16 : 2, 1, [&](int c, int r) {
      return round % 3 == 0 && gap(c, r) ? std::nan("") : random_() % 20 == 0 ? 5 : 0;
    });
    // Turned so that no side runs along an axis, but from post to post; far from the grid's origin, so that posts in
    // metres lie beside the posts in grid units by rounding.
    const auto ahead = static_cast<std::int32_t>(round % 4), aside = static_cast<std::int32_t>(round / 4 % 3);
    const auto east = static_cast<std::int32_t>(50000000 + random_() % 1000000),
               north = static_cast<std::int32_t>(400000000 + random_() % 1000000);
    for (GridPoint& p : tin.vertices) {
      if (ahead != 0) p = {ahead * p.x - aside * p.y, aside * p.x + ahead * p.y, p.z};
      p.x += east, p.y += north;
    }
    tin.grid.origin = {0, 0};
    std::vector<BoundaryEdge> rim = boundary_edges(tin);
    std::shuffle(rim.begin(), rim.end(), random_);
    Request request;
    for (std::size_t i = 0; i < 8; ++i) {
      const Point3 post = tin.point(rim[i].from);
      request.observers.push_back({std::to_string(i), {post.x, post.y}, std::array{0.0, 0.5, 1.0, 2.0}[i % 4]});
    }
    const Box box = tin.bounds();
    request.grid.emplace(Point2{box.xmin - 0.5, box.ymax + 0.5}, 1, 1, static_cast<std::int64_t>(box.width()) + 1,
                         static_cast<std::int64_t>(box.height()) + 1);
    request.nodata = round % 2 == 0 ? NoData::kClear : NoData::kUnknown;
    expect_same_by_both(request, {Mode::kWhich}, [&](const Request& r) { return compute(tin, r, progress_); });
  }
  EXPECT_GT(visible_, 200U);
  EXPECT_GT(hidden_, 200U);
}

/// From 40 km away single precision errs by metres sideways.
TEST_F(Engines, AgreeFarFromTheEye) {
  // From the first terrain's corner much is visible and much is not, from another's it may be next to nothing.
  for (const std::uint32_t seed : {7U, test::seed()}) {
    const Tin tin = test::fractal_tin(129, 400, 900, 0.6, seed);
    Request request = request_over(tin, 3);
    request.observers[0] = {"o", {test::kCorner.x + 10, test::kCorner.y + 10}, 30};
    expect_same_by_both(request, kFewModes, [&](const Request& r) { return compute(tin, r, progress_); });
  }
  EXPECT_GT(visible_, 200U);
  EXPECT_GT(hidden_, 200U);
}

/// Cells a step of the grid wide about an eye that stands on the ground under a roof: it sees its own cell alone. So
/// near the eye coordinates err by as much as a cell's slope may.
TEST_F(Engines, AgreeWithinStepsOfTheEye) {
  // Far from the grid's origin, as the stores of national grids are.
  Tin roof = test::random_tin(random_, 60, 0, {{0, 0}, 0.01}, 3000);
  for (GridPoint& p : roof.vertices) p.x += 30000000, p.y += 20000000;
  Tin ground = roof;
  for (GridPoint& p : ground.vertices) p.z -= 500;
  std::uniform_real_distribution<double> within(-20, 20);
  for (int i = 0; i < 500; ++i) {
    Request request;
    const Point2 eye{300000 + within(random_), 200000 + within(random_)};
    if (!height_on(ground, eye)) continue;
    request.observers = {{"o", eye, 0}};
    request.target_height = 1.7;
    request.nodata = NoData::kClear;
    request.grid.emplace(Point2{eye.x - 0.075, eye.y + 0.075}, 0.01, 0.01, 15, 15);
    expect_same_by_both(request, {Mode::kVisible}, [&](const Request& r) {
      const Result result = compute(roof, ground, r, progress_);
      EXPECT_EQ(result.cells.visible, 1U);
      return result;
    });
  }
}

/// A town of lidar and footprints, the bundled one.
class EnginesInTown : public Engines {
 protected:
  EnginesInTown() {
    test::import_alexandria(path());
    request_.observers = {{"street", {321800, 4297750}, 2}, {"roof", {321692.34, 4297619.88}, 25}};
    request_.cell_size = 4;
  }
  std::string path() const { return directory_.file("town.itin"); }

  const test::TemporaryDirectory directory_;
  Request request_;
};

TEST_F(EnginesInTown, AgreeOnThePlainSurface) {
  const Store store(path());
  for (const ThemeChoice& themes : {ThemeChoice::none(), ThemeChoice::all()}) {
    request_.themes = themes;
    for (const bool on_surface : {false, true}) {
      request_.targets_on_surface = on_surface;
      expect_same_by_both(request_, kFewModes, [&](const Request& r) { return compute(store, r, progress_); });
    }
  }
}

TEST_F(EnginesInTown, AgreeAtATolerance) {
  const Store store(path());
  request_.detail = Detail::tolerance(1);
  expect_same_by_both(request_, kFewModes, [&](const Request& r) { return compute(store, r, progress_); });
}

/// Segment by segment each engine says what it says of the whole.
TEST_F(EnginesInTown, AgreeInLittleMemory) {
  const Store store(path());
  request_.mode = Mode::kCount;
  for (const ThemeChoice& themes : {ThemeChoice::none(), ThemeChoice::all()}) {
    request_.themes = themes;
    request_.engine = Engine::kSweep;
    const Result whole = test::compute_at_full_detail(store, request_, {}, progress_).result;
    for (const Engine engine : {Engine::kSweep, Engine::kRays}) {
      request_.engine = engine;
      const Result parts = test::compute_at_full_detail(store, request_, {.memory_bytes = 12000000}, progress_).result;
      EXPECT_GT(parts.statistics.triangles, 0U);
      test::expect_same_result(whole, parts);
    }
  }
}

/// At a tolerance, too, the memory changes nothing, whatever the mode.
TEST_F(EnginesInTown, AgreeAtAToleranceInLittleMemory) {
  const Store store(path());
  request_.detail = Detail::tolerance(0.5);
  request_.vertical_error = {0.5, 30};
  for (const ThemeChoice& themes : {ThemeChoice::none(), ThemeChoice::all()}) {
    request_.themes = themes;
    for (const Mode mode : {Mode::kVisible, Mode::kBlocker, Mode::kProbability, Mode::kAngle}) {
      SCOPED_TRACE(static_cast<int>(mode));
      request_.mode = mode;
      const Result whole = compute_with_surface(store, request_, {}, progress_).result;
      const Result parts = compute_with_surface(store, request_, {.memory_bytes = 400000}, progress_).result;
      EXPECT_GT(parts.statistics.triangles, whole.statistics.triangles) << "not in segments";
      test::expect_same_result(whole, parts);
    }
  }
}

TEST_F(EnginesInTown, RaysLeaveLeastHeightsToTheSweep) {
  const Store store(path());
  request_.mode = Mode::kHeight;
  request_.engine = Engine::kRays;
  EXPECT_THROW(compute(store, request_, progress_), InputError);
  EXPECT_THROW(test::compute_at_full_detail(store, request_, {}, progress_), InputError);
}

TEST_F(EnginesInTown, SitesServeTheSame) {
  const Store store(path());
  const std::vector<Point2> places{{321800, 4297750}, {321700, 4297700}, {321850, 4297850}};
  const auto ground = ground_under(store, places, ThemeChoice::none(), progress_);
  SiteSurvey survey;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (ground[i]) survey.positions.push_back({std::to_string(i), places[i], 6, *ground[i]});
  ASSERT_GE(survey.positions.size(), 2U);
  survey.radius = 150;
  survey.nodata = NoData::kClear;
  survey.themes = ThemeChoice::all();
  survey.targets.height = 1.5;
  survey.targets.grid = grid_of_reach(store, survey.positions, survey.radius, 3);
  std::vector<std::vector<std::uint64_t>> served;
  for (const Engine engine : {Engine::kSweep, Engine::kRays}) {
    survey.engine = engine;
    SiteCoverage coverage(store, survey, progress_);
    coverage.explore();
    served.emplace_back();
    for (std::size_t option = 0; option < survey.positions.size(); ++option) {
      while (!coverage.bounds(option).exact) coverage.refine(std::vector{option});
      for (const DemandSet::Block& block : coverage.bounds(option).certain.blocks()) {
        served.back().push_back(block.number);
        served.back().push_back(block.members);
      }
    }
  }
  EXPECT_GT(served[0].size(), 10U);
  EXPECT_EQ(served[0], served[1]);
}

}  // namespace
}  // namespace itin::viewshed
