// Segments of a plan, decided in any order and by several runners, are the viewshed at once.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/plan.hpp>
#include <viewshed/surface.hpp>

#include "support/hills_and_town.hpp"
#include "support/same_result.hpp"
#include "support/seed.hpp"

namespace itin::viewshed {
namespace {

class Plans : public testing::Test {
 protected:
  static void SetUpTestSuite() { stores_ = new test::HillsAndTown; }
  static void TearDownTestSuite() {
    delete stores_;
    stores_ = nullptr;
  }
  static std::string hills_path() { return stores_->hills(); }
  static std::string town_path() { return stores_->town(); }
  static Request over_hills() { return test::HillsAndTown::over_hills(); }
  static Request over_town() { return test::HillsAndTown::over_town(); }

  /// The segments in a random order, every third of them as a file.
  Result merged(const Store& store, const Plan& plan) {
    std::vector<std::size_t> order(plan.segments().size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random_);
    Merge merge(plan);
    for (const std::size_t i : order) {
      Result result = decide(store, plan, i, progress_);
      if (i % 3 == 0) {
        const std::string path = stores_->file("segment");
        write_segment(path, plan, i, result);
        const Result read = read_segment(path, plan, i);
        test::expect_same_result(result, read);
        result = read;
      }
      merge.add(i, result);
    }
    return merge.take();
  }

  void expect_whole(const Store& store, const Request& request, const ComputeOptions& options,
                    std::uint64_t most_cells = kAnyNumberOfCells) {
    const Result whole = compute(store, request, progress_);
    const Plan plan(store, request, options, most_cells);
    EXPECT_GT(plan.segments().size(), 2U);
    const Result parts = merged(store, plan);
    test::expect_same_result(whole, parts);
    EXPECT_EQ(parts.ground_m, whole.ground_m);
    EXPECT_EQ(parts.theme_names, whole.theme_names);
    visible_ += whole.cells.visible, hidden_ += whole.cells.hidden;
  }

  static inline test::HillsAndTown* stores_ = nullptr;
  std::mt19937 random_{test::seed()};
  NoProgress progress_;
  std::uint64_t visible_ = 0, hidden_ = 0;
};

TEST_F(Plans, MakeTheWholeInEveryMode) {
  const Store store(hills_path());
  for (const Mode mode : test::kEveryMode) {
    SCOPED_TRACE(static_cast<int>(mode));
    expect_whole(store, test::HillsAndTown::in_mode(mode, over_hills()), {.memory_bytes = 6000000}, 20000);
  }
  EXPECT_GT(visible_, 1000U);
  EXPECT_GT(hidden_, 1000U);
}

TEST_F(Plans, MakeTheWholeAcrossMissingGround) {
  const Store store(hills_path());
  for (const NoData nodata : {NoData::kUnknown, NoData::kBlock, NoData::kClear}) {
    for (const Mode mode : {Mode::kVisible, Mode::kHeight, Mode::kBlocker}) {
      SCOPED_TRACE(static_cast<int>(mode));
      Request request = over_hills();
      request.nodata = nodata;
      request.mode = mode;
      expect_whole(store, request, {}, 5000);
    }
  }
}

TEST_F(Plans, MakeTheWholeAtATolerance) {
  const Store store(hills_path());
  Request request = over_hills();
  request.mode = Mode::kWhich;
  request.detail = Detail::tolerance(4);
  expect_whole(store, request, {}, 8000);
  request.detail = Detail::rings({301500, 202500}, {{600, 0}, {1500, 2}, {3000, 8}});
  expect_whole(store, request, {.memory_bytes = 8000000}, 30000);
}

TEST_F(Plans, MakeTheWholeInATown) {
  const Store store(town_path());
  for (const Mode mode : test::kEveryMode) {
    SCOPED_TRACE(static_cast<int>(mode));
    expect_whole(store, test::HillsAndTown::in_mode(mode, over_town()), {}, 8000);
  }
}

/// Over the full surface in segments.
TEST_F(Plans, MakeTheWholeOfWhatIsCertain) {
  for (const bool town : {false, true}) {
    const Store store(town ? town_path() : hills_path());
    Request request = town ? over_town() : over_hills();
    request.detail = Detail::tolerance(4);
    const Result whole = compute_certified(store, request, {}, progress_).result;
    const Plan plan(store, request, {}, 6000, Certainty::kCertified);
    EXPECT_TRUE(plan.decides_exactly());
    EXPECT_GT(plan.segments().size(), 2U);
    const Result parts = merged(store, plan);
    EXPECT_TRUE(parts.certified);
    EXPECT_EQ(parts.ground_m, whole.ground_m);
    test::expect_same_result(whole, parts);
    EXPECT_NE(plan.id(), Plan(store, request, {}, 6000).id());
  }
}

/// Over a level that costs less than the full surface, which is one segment.
TEST_F(Plans, MakeTheWholeOfWhatALevelIsCertainOf) {
  const std::vector<double> z = test::fractal_heights(513, 300, 0.55, 12);
  test::write_raster(stores_->file("large.tif"), {300000, 210000, 25, 400, 400, 27700},
                     [&](int c, int r) { return z[static_cast<std::size_t>(r) * 513 + static_cast<std::size_t>(c)]; });
  ImportOptions options;
  options.sources = {stores_->file("large.tif")};
  options.to_crs = "EPSG:32630";  // so that posts lie on no lattice
  import_terrain(stores_->file("large.itin"), options, progress_);
  const Store store(stores_->file("large.itin"));
  Request request;
  const Box box = extent_of(store);
  request.observers = {{"mast", {(box.xmin + box.xmax) / 2, (box.ymin + box.ymax) / 2}, 30}};
  request.cell_size = 100;
  request.detail = Detail::tolerance(16);
  const Result whole = compute_certified(store, request, {}, progress_).result;
  EXPECT_GT(whole.cells.undecided, 0U);
  EXPECT_GT(whole.cells.hidden, 1000U);
  const Plan plan(store, request, {}, 600, Certainty::kCertified);
  EXPECT_FALSE(plan.decides_exactly());
  test::expect_same_result(whole, merged(store, plan));
}

/// With either engine, and with ends on the roofs.
TEST_F(Plans, MakeTheWholeWithRays) {
  const Store store(town_path());
  Request request = over_town();
  request.engine = Engine::kRays;
  request.observers_on_surface = request.targets_on_surface = true;
  request.mode = Mode::kNearest;
  expect_whole(store, request, {}, 8000);
}

/// More observers than one word of bits holds, most of whom reach few segments.
TEST_F(Plans, NumberObserversAsTheWholeDoes) {
  const Store store(hills_path());
  Request request = over_hills();
  request.observers.clear();
  std::uniform_real_distribution<double> along(100, 3900);
  while (request.observers.size() < 70) {
    Observer observer{std::to_string(request.observers.size()), {300000 + along(random_), 200000 + along(random_)}, 10};
    if (std::hypot(observer.position.x - 301200, observer.position.y - 201600) < 300) continue;
    observer.radius = 500;
    request.observers.push_back(observer);
  }
  for (const Mode mode : {Mode::kCount, Mode::kWhich, Mode::kNearest}) {
    request.mode = mode;
    expect_whole(store, request, {}, 9000);
  }
}

TEST_F(Plans, ListSegmentsNearestFirstEachCellOnce) {
  const Store store(hills_path());
  Request request = over_hills();
  request.observers.resize(1);
  request.radius = 900;
  const std::uint64_t memory = 3000000;
  const Plan plan(store, request, {.memory_bytes = memory}, 4096);
  ASSERT_GT(plan.segments().size(), 4U);
  std::vector<int> times(plan.grid().cell_count());
  double last = 0;
  for (const Segment& s : plan.segments()) {
    EXPECT_GE(s.distance_m, last);
    last = s.distance_m;
    EXPECT_LE(s.columns * s.rows, 4096);
    EXPECT_THAT(s.observers, testing::ElementsAre(0));
    EXPECT_GT(s.points, 0U);
    for (std::int64_t row = 0; row < s.rows; ++row)
      for (std::int64_t column = 0; column < s.columns; ++column)
        ++times[plan.grid().index({s.north_west.column + column, s.north_west.row + row})];
  }
  EXPECT_EQ(last <= 900, true);
  EXPECT_EQ(*std::max_element(times.begin(), times.end()), 1);
  const Result whole = compute(store, request, progress_);
  for (std::size_t cell = 0; cell < times.size(); ++cell)
    if (whole.visible[cell] != Verdict::kOutside) {
      ASSERT_EQ(times[cell], 1) << cell;
    }
}

TEST_F(Plans, KeepASubgridsCentres) {
  const RasterGrid whole({300000.1, 204000.7}, 0.3, 0.7, 1000, 900);
  const RasterGrid part = whole.part({123, 77}, 200, 300).part({50, 60}, 20, 30);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(part.centre(i, i).x, whole.centre(173 + i, 137 + i).x);
    EXPECT_EQ(part.centre(i, i).y, whole.centre(173 + i, 137 + i).y);
  }
  EXPECT_TRUE(part == whole.part({173, 137}, 20, 30));
  EXPECT_THROW(std::ignore = part.part({1, 0}, 20, 30), InputError);
  EXPECT_THROW(std::ignore = part.part({0, 0}, 0, 1), InputError);
  EXPECT_THROW(std::ignore = part.part({-1, 0}, 2, 2), InputError);
}

TEST_F(Plans, AreEqualForEqualRequestsAlone) {
  const Store store(hills_path());
  const Request request = over_hills();
  const ComputeOptions options{.memory_bytes = 6000000};
  const std::uint64_t id = Plan(store, request, options).id();
  EXPECT_EQ(Plan(Store(hills_path()), request, options).id(), id);
  Request other = request;
  other.observers[2].height += 1e-9;
  EXPECT_NE(Plan(store, other, options).id(), id);
  other = request;
  other.mode = Mode::kCount;
  EXPECT_NE(Plan(store, other, options).id(), id);
  EXPECT_NE(Plan(store, request, options, 5000).id(), id);
  EXPECT_NE(Plan(Store(town_path()), over_town(), options).id(), id);
}

TEST_F(Plans, TakeTheirOwnSegmentsAlone) {
  const Store store(hills_path());
  Request request = over_hills();
  const Plan plan(store, request, {}, 20000);
  ASSERT_GT(plan.segments().size(), 2U);
  Merge merge(plan);
  const Result first = decide(store, plan, 0, progress_);
  merge.add(0, first);
  merge.add(0, first);
  EXPECT_EQ(merge.missing().size(), plan.segments().size() - 1);
  EXPECT_THROW(std::ignore = merge.take(), InputError);
  EXPECT_THROW(merge.add(1, first), InputError);

  const std::string path = stores_->file("first");
  write_segment(path, plan, 0, first);
  EXPECT_THROW(std::ignore = read_segment(path, plan, 1), InputError);
  request.target_height = 3;
  EXPECT_THROW(std::ignore = read_segment(path, Plan(store, request, {}, 20000), 0), InputError);
  EXPECT_THROW(std::ignore = read_segment(stores_->file("none"), plan, 0), FileError);
}

/// Whatever byte of it is damaged or missing.
TEST_F(Plans, RefuseDamagedFiles) {
  const Store store(hills_path());
  Request request = over_hills();
  request.mode = Mode::kBlocker;
  const Plan plan(store, request, {}, 20000);
  const std::string path = stores_->file("segment");
  write_segment(path, plan, 0, decide(store, plan, 0, progress_));
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  for (std::size_t round = 0; round < 200; ++round) {
    std::string damaged = bytes;
    const std::size_t at = round < 40 ? round : random_() % bytes.size();
    if (round % 2 == 0) {
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << round % 8));
    } else {
      damaged.resize(at);
    }
    std::ofstream(path, std::ios::binary | std::ios::trunc) << damaged;
    EXPECT_THROW(std::ignore = read_segment(path, plan, 0), FileError) << at;
  }
}

/// Cells of a request's own warn of missing ground where a line to them can cross it, and nowhere else.
TEST_F(Plans, KnowWhereLinesCrossMissingGround) {
  const Store store(hills_path());
  Request request = over_hills();
  request.observers.resize(1);
  request.mode = Mode::kHeight;
  request.cell_size.reset();
  request.grid.emplace(Point2{302500, 203500}, 20, 20, 50, 50);
  EXPECT_FALSE(compute(store, request, progress_).crosses_voids);
  request.grid.emplace(Point2{300500, 201000}, 20, 20, 20, 20);
  EXPECT_TRUE(compute(store, request, progress_).crosses_voids);
}

}  // namespace
}  // namespace itin::viewshed
