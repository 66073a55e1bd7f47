// The one run that leaves lines across missing ground open, against the two in which these pass and are blocked.
#include <cmath>
#include <gmock/gmock.h>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/viewshed.hpp>
#include <viewshed/zone_files.hpp>

#include "bounds/pixel_heights.hpp"
#include "exact/lattice_sectors.hpp"
#include "line/infinity.hpp"
#include "support/full_detail.hpp"
#include "support/raster_file.hpp"
#include "support/same_result.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"
#include "support/told_progress.hpp"
#include "support/vector_file.hpp"

namespace itin::viewshed {
namespace {

constexpr std::uint64_t kMuch = 1 << 30;

/// To the last bit; no number is the same as no number.
class VerdictsOverVoids : public testing::Test {
 protected:
  static constexpr int kSide = 193;
  static constexpr double kStep = 25, kWest = 300000, kNorth = 200000;

  void SetUp() override {
    const std::vector<double> z = test::fractal_heights(257, 300, 0.6, random_());
    test::write_raster(directory_.file("t.tif"), {kWest, kNorth, kStep, kSide, kSide, 27700}, [&](int c, int r) {
      const bool missing = std::hypot(c - 60, r - 110) < 25 || std::hypot(c - 120, r - 60) < 12;
      return missing ? NAN : z[static_cast<std::size_t>(r) * 257 + static_cast<std::size_t>(c)];
    });
    ImportOptions options;
    options.sources = {directory_.file("t.tif")};
    import_terrain(path(), options, progress_);
  }

  std::string path() const { return directory_.file("t.itin"); }

  /// From the eastern edge, the middle and the southern edge, where no void is.
  Request look() {
    std::uniform_real_distribution<double> nudge(-100, 100);
    Request request;
    for (const auto& [c, r] : {std::pair{180, 90}, {96, 96}, {100, 180}}) {
      Observer observer;
      observer.position = {kWest + c * kStep + nudge(random_), kNorth - r * kStep + nudge(random_)};
      observer.height = 60;
      request.observers.push_back(observer);
    }
    request.observers[1].radius = 1500;
    request.target_height = 20;
    request.cell_size = 30;
    return request;
  }

  /// Made of the answers where missing ground hides nothing and where it hides.
  Result of_two_runs(const Store& store, const Request& request) {
    const auto run = [&](NoData rule) {
      Request exact = request;
      exact.mode = Mode::kVisible;
      exact.nodata = rule;
      return test::compute_at_full_detail(store, exact, {}, progress_).result;
    };
    Result open = run(NoData::kClear);
    const Result closed = run(NoData::kBlock);
    open.cells = {};
    for (std::size_t i = 0; i < open.visible.size(); ++i) {
      Verdict& value = open.visible[i];
      ++(value == Verdict::kOutside              ? open.cells.outside
         : value == Verdict::kHidden             ? open.cells.hidden
         : closed.visible[i] == Verdict::kHidden ? open.cells.undecided
                                                 : open.cells.visible);
      if (value != Verdict::kOutside)
        value = value == Verdict::kHidden               ? Verdict::kHidden
                : closed.visible[i] == Verdict::kHidden ? Verdict::kUndecided
                                                        : Verdict::kVisible;
    }
    return open;
  }

  static void expect_same(const Result& expected, const Result& found) {
    EXPECT_TRUE(found.visible == expected.visible);
    EXPECT_EQ(found.cells.visible, expected.cells.visible);
    EXPECT_EQ(found.cells.hidden, expected.cells.hidden);
    EXPECT_EQ(found.cells.undecided, expected.cells.undecided);
    EXPECT_EQ(found.cells.outside, expected.cells.outside);
    EXPECT_TRUE(found.warnings.empty());
  }

  const test::TemporaryDirectory directory_;
  std::mt19937 random_{test::seed()};
  NoProgress progress_;
};

TEST_F(VerdictsOverVoids, OneRunIsTwoInAnyMemory) {
  const Store store(path());
  const Request request = look();
  const Result expected = of_two_runs(store, request);
  ASSERT_GT(expected.cells.undecided, 100U);
  ASSERT_GT(expected.cells.visible, 100U);
  // By its posts; the whole at once; a coarse pass and segments.
  for (const ComputeOptions& options : {ComputeOptions{kMuch, true}, {kMuch, false}, {4000000, false}}) {
    SCOPED_TRACE(options.memory_bytes);
    expect_same(expected, test::compute_at_full_detail(store, request, options, progress_).result);
  }
  const auto sectors = compute_by_lattice_sectors(store, request, 400000, {}, progress_);
  ASSERT_TRUE(sectors);
  expect_same(expected, sectors->result);
  EXPECT_GT(sectors->result.statistics.triangles, std::uint64_t{2 * kSide * kSide}) << "not in sectors";
}

TEST_F(VerdictsOverVoids, NothingIsOpenUnderTheOtherRules) {
  const Store store(path());
  Request request = look();
  for (const NoData rule : {NoData::kClear, NoData::kBlock}) {
    request.nodata = rule;
    Request exact = request;
    exact.mode = Mode::kVisible;
    const Result expected = test::compute_at_full_detail(store, exact, {}, progress_).result;
    for (const std::uint64_t memory : {kMuch, std::uint64_t{4000000}}) {
      const Result found = test::compute_at_full_detail(store, request, {memory, false}, progress_).result;
      EXPECT_EQ(found.cells.undecided, 0U);
      EXPECT_EQ(found.cells.visible, expected.cells.visible);
      EXPECT_EQ(found.cells.hidden, expected.cells.hidden);
    }
  }
}

TEST_F(VerdictsOverVoids, AreThoseOfEveryMode) {
  const Store store(path());
  Request request = look();
  const Result expected = of_two_runs(store, request);
  request.vertical_error = {2, 0};
  for (const Mode mode : {Mode::kBlocker, Mode::kHeight, Mode::kProbability}) {
    SCOPED_TRACE(static_cast<int>(mode));
    request.mode = mode;
    for (const std::uint64_t memory : {kMuch, std::uint64_t{4000000}})
      expect_same(expected, test::compute_at_full_detail(store, request, {memory, false}, progress_).result);
  }
}

/// What single observers find where voids hide nothing tells what all find, and what is not known of it: the values of
/// those whose lines cross a void, which no height is seen across where it blocks, are bounds.
TEST_F(VerdictsOverVoids, LeaveValuesOpenThatTheyCouldChange) {
  const Store store(path());
  Request request = look();
  request.grid = compute(store, request, progress_).grid;
  request.cell_size.reset();
  request.vertical_error = {2, 0};
  const auto values = [&](Mode mode, NoData rule, const std::vector<Observer>& observers) {
    Request of = request;
    of.mode = mode, of.nodata = rule, of.observers = observers;
    const Result result = test::compute_at_full_detail(store, of, {}, progress_).result;
    return mode == Mode::kHeight ? result.get<LeastHeights>().height_m : result.get<Probabilities>().probability;
  };
  for (const Mode mode : {Mode::kHeight, Mode::kProbability}) {
    SCOPED_TRACE(static_cast<int>(mode));
    // A value is the better the greater it is.
    const float sign = mode == Mode::kHeight ? -1 : 1, worst = mode == Mode::kHeight ? -kFloatInfinity : 0;
    const std::vector<float> found = values(mode, NoData::kUnknown, request.observers);
    std::vector<float> known(found.size(), worst), open = known;
    std::vector<bool> seen_by_any(found.size());
    for (const Observer& observer : request.observers) {
      const std::vector<float> clear = values(mode, NoData::kClear, {observer});
      const std::vector<float> beyond_voids = values(Mode::kHeight, NoData::kBlock, {observer});
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (std::isnan(clear[i])) continue;
        seen_by_any[i] = true;
        float& best = (std::isnan(beyond_voids[i]) ? open : known)[i];
        best = std::max(best, sign * clear[i]);
      }
    }
    std::size_t unknown = 0, told = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const bool is_known = seen_by_any[i] && known[i] >= open[i] && !std::isinf(known[i]);
      ASSERT_EQ(!std::isnan(found[i]), is_known) << "cell " << i;
      if (is_known) {
        ASSERT_EQ(sign * found[i], known[i]) << "cell " << i;
      }
      (is_known ? told : unknown) += seen_by_any[i] ? 1 : 0;
    }
    EXPECT_GT(unknown, 100U);
    EXPECT_GT(told, 100U);
  }
}

TEST_F(VerdictsOverVoids, HaveNoProbabilityWhereTheyBlock) {
  const Store store(path());
  Request request = look();
  request.observers.resize(1);
  request.nodata = NoData::kBlock;
  request.vertical_error = {5, 0};
  const auto compute_in = [&](Mode mode) {
    request.mode = mode;
    return test::compute_at_full_detail(store, request, {}, progress_).result;
  };
  const Result heights = compute_in(Mode::kHeight), probabilities = compute_in(Mode::kProbability);
  std::size_t behind = 0;
  for (std::size_t i = 0; i < heights.visible.size(); ++i) {
    if (heights.visible[i] == Verdict::kOutside || !std::isnan(heights.get<LeastHeights>().height_m[i])) continue;
    ++behind;
    ASSERT_EQ(probabilities.get<Probabilities>().probability[i], 0) << "cell " << i;
  }
  EXPECT_GT(behind, 100U);
}

TEST_F(VerdictsOverVoids, ProgressOnlyGrowsAndReachesTheEnd) {
  const Store store(path());
  const Request request = look();
  // The observers see a part of the cells alone.
  for (const Mode mode : {Mode::kVisible, Mode::kAngle}) {
    Request of_mode = request;
    of_mode.mode = mode;
    test::ToldProgress whole, segments, sectors;
    test::compute_at_full_detail(store, of_mode, {kMuch, false}, whole);
    whole.expect_whole("sight lines");
    test::compute_at_full_detail(store, of_mode, {4000000, false}, segments);
    segments.expect_whole("sight lines");
    ASSERT_TRUE(compute_by_lattice_sectors(store, of_mode, 400000, {}, sectors));
    sectors.expect_whole("sight lines");
  }
}

/// Certificates know nothing of what stands on the ground: all of it under the lines is read, segment by segment.
TEST_F(VerdictsOverVoids, FeaturesChangeNothingOfThat) {
  test::write_lines(directory_.file("b.geojson"), {test::box(kWest + 500, kNorth - 600, kWest + 600, kNorth - 500, 20)},
                    true);
  ImportOptions options;
  options.sources = {directory_.file("b.geojson")};
  options.kind = ThemeKind::Buildings;
  options.height_field = "h";
  import_lines(path(), options, progress_);
  const Store store(path());
  Request request = look();
  request.themes = ThemeChoice::all();
  for (const Mode mode : {Mode::kVisible, Mode::kHeight, Mode::kAngle, Mode::kCount}) {
    for (const NoData rule : {NoData::kUnknown, NoData::kBlock}) {
      SCOPED_TRACE(static_cast<int>(mode));
      request.mode = mode, request.nodata = rule;
      const Result whole = test::compute_at_full_detail(store, request, {kMuch, false}, progress_).result;
      const Result parts = test::compute_at_full_detail(store, request, {4000000, false}, progress_).result;
      EXPECT_TRUE(parts.visible == whole.visible);
      EXPECT_TRUE(test::same_values(parts.values, whole.values));
      const bool undecided = rule == NoData::kUnknown;
      EXPECT_EQ(parts.cells.undecided > 0, undecided);
    }
  }
}

/// Whether each cell lies in a field of view and has no ground, asked one by one. Where an observer has no radius, only
/// cells whose centres lie within the box of all data are looked at.
std::vector<std::uint8_t> without_ground(const Store& store, const Result& result) {
  NoProgress progress;
  std::vector<std::uint8_t> cells;
  const std::vector<float> heights =
      heights_at(triangulate(store, Window::all(), Detail::tolerance(0), progress), result.grid);
  for (std::int64_t row = 0; row < result.grid.rows(); ++row)
    for (std::int64_t column = 0; column < result.grid.columns(); ++column) {
      const Point2 p = result.grid.centre(column, row);
      bool in_view = false;
      for (const Observer& o : result.request.observers) {
        const double dx = p.x - o.position.x, dy = p.y - o.position.y;
        const double azimuth = std::fmod(std::atan2(dx, dy) * 57.29577951308232 + 360, 360);
        in_view = in_view || (std::hypot(dx, dy) <= o.radius.value_or(1e9) &&
                              (!o.azimuth || (azimuth >= o.azimuth->from && azimuth <= o.azimuth->to)));
      }
      const auto& observers = result.request.observers;
      const bool bounded = std::all_of(observers.begin(), observers.end(), [](const Observer& o) { return o.radius; });
      in_view = in_view && (bounded || store.metadata().grid.box(store.metadata().bounds).contains(p));
      cells.push_back(in_view && std::isnan(heights[result.grid.index({column, row})]) ? 1 : 0);
    }
  return cells;
}

TEST(MissingGround, IsNoneOrAllOnlyWhereItIs) {
  const auto percent = [](std::uint64_t without, std::uint64_t with) {
    return MissingGround{.without_ground = without, .with_ground = with, .cell_area = 1}.percent();
  };
  EXPECT_EQ(percent(0, 5000), "0.0 %");
  EXPECT_EQ(percent(1, 4999), "less than 0.1 %");
  EXPECT_EQ(percent(615, 4385), "12.3 %");
  EXPECT_EQ(percent(4999, 1), "more than 99.9 %");
  EXPECT_EQ(percent(5000, 0), "100.0 %");
}

TEST_F(VerdictsOverVoids, CellsInViewWithoutGroundAreTold) {
  const Store store(path());
  Request request = look();
  request.observers.front().azimuth = {200, 330};
  request.observers.back().radius = 900;
  for (const bool bounded : {false, true}) {
    if (bounded) request.elevation = {-1.5, 0.5};
    const Result result = test::compute_at_full_detail(store, request, {kMuch, true}, progress_).result;
    const MissingGround missing = missing_ground(store, result, progress_);
    const std::vector<std::uint8_t> cells = cells_without_ground(store, result, progress_);
    EXPECT_EQ(cells, without_ground(store, result));
    EXPECT_EQ(missing.without_ground, static_cast<std::uint64_t>(std::count(cells.begin(), cells.end(), 1)));
    EXPECT_GT(missing.without_ground, 0U);
    EXPECT_LT(missing.without_ground, result.cells.outside);
    EXPECT_EQ(missing.beyond, 0U);
    EXPECT_FALSE(missing.warning("the area"));  // as far as there is ground
  }
}

TEST_F(VerdictsOverVoids, AFieldOfViewMayReachBeyondTheData) {
  const Store store(path());
  Request request = look();
  request.observers.erase(request.observers.begin() + 1, request.observers.end());
  request.radius = 3000;
  const Result result = test::compute_at_full_detail(store, request, {kMuch, true}, progress_).result;
  const MissingGround missing = missing_ground(store, result, progress_);
  const double disc = std::numbers::pi * 3000 * 3000;
  EXPECT_NEAR(missing.missing_m2() + static_cast<double>(missing.with_ground) * 900, disc, 0.002 * disc);
  EXPECT_GT(missing.beyond, 0U);
  EXPECT_NEAR(missing.share(), 1 - static_cast<double>(missing.with_ground) * 900 / disc, 0.002);
  EXPECT_THAT(missing.warning("the area").value(), testing::HasSubstr("`sea_level`"));
  EXPECT_EQ(missing.key_text("the area"), "No ground data: " + missing.text() + " of the area");
  // A map tells beyond the raster, too.
  const PlacesWithoutGround places = places_without_ground(store, result, progress_);
  const std::vector<std::uint8_t> cells = cells_without_ground(store, result, progress_);
  const RasterGrid wide = RasterGrid::aligned(square_about(request.observers.front().position, 3200), 30);
  std::size_t on_raster = 0, beyond = 0;
  for (std::int64_t row = 0; row < wide.rows(); ++row)
    for (std::int64_t column = 0; column < wide.columns(); ++column) {
      const Point2 p = wide.centre(column, row), eye = request.observers.front().position;
      const auto cell = result.grid.cell_at(p);
      const bool in_view = std::hypot(p.x - eye.x, p.y - eye.y) <= 3000;
      EXPECT_EQ(places.contain(p), cell ? cells[result.grid.index(*cell)] == 1 : in_view);
      if (places.contain(p)) ++(cell ? on_raster : beyond);
    }
  EXPECT_EQ(on_raster, missing.without_ground);
  EXPECT_EQ(beyond, missing.beyond);
  // Of very many cells beyond, with larger ones.
  request.radius = 300000;
  const Result far = test::compute_at_full_detail(store, request, {kMuch, true}, progress_).result;
  const double all = std::numbers::pi * 3e5 * 3e5;
  EXPECT_NEAR(missing_ground(store, far, progress_).missing_m2(), all, 0.001 * all);
}

TEST_F(VerdictsOverVoids, ZonesKnowWhatOfThemHasNoGround) {
  const Store store(path());
  ZoneRequest request;
  request.cell_size = 50;
  for (const auto& [x, y] : {std::pair{600, -600}, {2500, -1000}}) {
    Turbine turbine;
    turbine.number = request.turbines.size() + 1;
    turbine.position = {kWest + x, kNorth + y};
    turbine.tip_height = 100, turbine.radius = 2000;
    request.turbines.push_back(turbine);
  }
  const Zone zone = survey_turbines(store, request, progress_);
  const MissingGround missing = missing_ground(zone);
  // Two discs 1,942 m apart.
  const double d = std::hypot(1900, 400), r = 2000,
               lens = 2 * r * r * std::acos(d / (2 * r)) - d / 2 * std::sqrt(4 * r * r - d * d),
               area = 2 * std::numbers::pi * r * r - lens;
  EXPECT_NEAR(missing.study_m2(), area, 0.003 * area);
  EXPECT_GT(missing.without_ground, 100U);
  EXPECT_GT(missing.beyond, 1000U);
  // Rings and what of them has data make up the same.
  std::istringstream table(area_table(zone));
  std::string line;
  std::getline(table, line);
  double sum = 0;
  while (std::getline(table, line)) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (cells[1] == "tip") sum += std::stod(cells[5]) / std::stod(cells[7]) * 100;
  }
  EXPECT_NEAR(sum * 1e6, missing.study_m2(), 0.002 * area);
}

}  // namespace
}  // namespace itin::viewshed
