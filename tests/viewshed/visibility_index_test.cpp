// The visibility index against whole viewsheds of single observers.
#include <cmath>

#include <gtest/gtest.h>

#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/parallel.hpp>
#include <itin/triangulate.hpp>
#include <profile/los.hpp>
#include <viewshed/tasks.hpp>
#include <viewshed/visibility_index.hpp>

#include "index/index_plan.hpp"
#include "index/line_tester.hpp"
#include "index/visibility_sampler.hpp"
#include "support/houses.hpp"
#include "support/raster_file.hpp"
#include "support/real_terrain.hpp"
#include "support/same_bits.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin::viewshed {
namespace {

class VisibilityIndexTest : public testing::Test {
 protected:
  void import_posts(const std::function<double(int, int)>& height) const {
    test::write_raster(directory_.file("t.tif"), {300000, 200000, 50, 80, 80, 27700}, height);
    ImportOptions options;
    options.sources = {directory_.file("t.tif")};
    NoProgress progress;
    import_terrain(path_, options, progress);
  }

  /// Hills with two lakes of no data.
  void import_hills() const {
    const test::CardiffTerrain terrain;
    import_posts([&](int c, int r) {
      return std::hypot(c - 50, r - 30) < 6 || std::hypot(c - 20, r - 60) < 3 ? std::nan("")
                                                                              : terrain(c + 200, r + 150);
    });
  }

  void import_houses() const {
    std::vector<test::LineFeature> houses;
    for (int i = 0; i < 40; ++i) {
      const int column = i % 8, row = i / 8;
      const double x = 300500 + 355 * column, y = 199500 - 613 * row;
      houses.push_back(test::box(x, y, x + 30, y + 20, 12));
    }
    test::import_houses(path_, directory_.file("h.geojson"), houses);
  }

  static void expect_same(const VisibilityIndex& a, const VisibilityIndex& b) {
    ASSERT_EQ(a.share.size(), b.share.size());
    for (std::size_t i = 0; i < a.share.size(); ++i) {
      ASSERT_TRUE(test::same_bits(a.share[i], b.share[i])) << "cell " << i;
      ASSERT_TRUE(test::same_bits(a.standard_error[i], b.standard_error[i])) << "cell " << i;
      ASSERT_TRUE(test::same_bits(a.undecided[i], b.undecided[i])) << "cell " << i;
    }
    EXPECT_EQ(a.lines, b.lines);
    EXPECT_EQ(a.observers, b.observers);
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.mean_undecided, b.mean_undecided);
  }

  void expect_blocks_make_the_whole(IndexRequest request, const std::vector<std::uint64_t>& memories) const {
    request.memory_bytes = std::uint64_t{1} << 30;
    const VisibilityIndex whole = index(request);
    for (const std::uint64_t memory : memories) {
      SCOPED_TRACE(memory);
      request.memory_bytes = memory;
      const VisibilityIndex blocks = index(request);
      EXPECT_GT(blocks.triangles, whole.triangles) << "not in blocks";
      expect_same(blocks, whole);
    }
    request.memory_bytes = std::uint64_t{1} << 30;
    for (const std::uint64_t most_cells : {50U, 7U}) {
      const Store store(path_);
      NoProgress progress;
      IndexTasks tasks(store, request, most_cells, progress);
      EXPECT_GT(tasks.list().size(), 2U);
      for (std::size_t i = tasks.list().size(); i-- > 0;) tasks.add(i, tasks.answer(i, progress));
      expect_same(tasks.take(), whole);
    }
  }

  /// Every line of some eyes of an index, as a viewshed and a line of sight have it.
  void expect_lines_of_viewsheds(const IndexRequest& request) const {
    const Store store(path_);
    NoProgress progress;
    const auto surface = [&](const ThemeChoice& themes) {
      return RetrievedSurface{triangulate(store, Window::all(), request.detail, progress, themes), nullptr, {}};
    };
    const RetrievedSurface full = surface(request.themes), bare = surface(ThemeChoice::none());
    const LineTester screen(full, request.earth, 0), ground(bare, request.earth, 0);
    const VisibilitySampler sampler(screen, ground, {request.radius, request.target_height, *request.targets},
                                    request.nodata);
    int visible = 0, hidden = 0, undecided = 0;
    for (const Point2 eye : {Point2{301500, 197900}, {302225, 198725}, {301325, 197425}, {302800, 197300}}) {
      const std::optional<double> height = sampler.ground(eye);
      ASSERT_TRUE(height);
      sampler.observe(eye, *height + request.height, 7, [&](Point2 target, Verdict verdict) {
        visible += verdict == Verdict::kVisible, hidden += verdict == Verdict::kHidden;
        undecided += verdict == Verdict::kUndecided;
        EXPECT_EQ(verdict_in_viewshed(store, request, eye, target), verdict)
            << eye.x << ' ' << target.x << ' ' << target.y;
        EXPECT_EQ(verdict_along_line(store, request, eye, target), verdict)
            << eye.x << ' ' << target.x << ' ' << target.y;
      });
    }
    EXPECT_EQ(undecided > 0, request.nodata == NoData::kUnknown);
    EXPECT_GT(visible, 50);
    EXPECT_GT(hidden, 50);
  }

  static Verdict verdict_in_viewshed(const Store& store, const IndexRequest& index, Point2 eye, Point2 target) {
    Request request;
    request.observers = {{"o", eye, index.height}};
    request.target_height = index.target_height;
    request.grid = RasterGrid({target.x - 0.5, target.y + 0.5}, 1, 1, 1, 1);
    request.themes = index.themes;
    request.nodata = index.nodata;
    NoProgress progress;
    return compute(store, request, progress).visible[0];
  }

  static Verdict verdict_along_line(const Store& store, const IndexRequest& index, Point2 eye, Point2 target) {
    const auto along = [&](const ThemeChoice& themes) {
      return profile::from_section(cross_section(store, eye, target, index.detail, themes));
    };
    profile::LosQuery query;
    query.from_height_m = index.height, query.to_height_m = index.target_height;
    query.earth = index.earth;
    query.nodata = index.nodata;
    const bool raised = index.themes.includes_raised(store.metadata().themes);
    switch (profile::analyse(along(index.themes), query, raised ? along(ThemeChoice::none()) : profile::Profile{})
                .verdict) {
      case profile::SightVerdict::kVisible:
        return Verdict::kVisible;
      case profile::SightVerdict::kHidden:
        return Verdict::kHidden;
      case profile::SightVerdict::kUndecided:
        return Verdict::kUndecided;
    }
    return Verdict::kOutside;
  }

  VisibilityIndex index(const IndexRequest& request) const {
    NoProgress progress;
    return visibility_index(Store(path_), request, progress);
  }

  /// The share of the ground within the radius of one place that is seen from it, by a cell every 10 m.
  double share_seen(Point2 place, const IndexRequest& request) const {
    Request look;
    look.observers = {{"o", place, request.height}};
    look.target_height = request.target_height;
    look.radius = request.radius;
    look.cell_size = 10;
    look.nodata = request.nodata;
    NoProgress progress;
    const CellCounts cells = compute(Store(path_), look, progress).cells;
    return static_cast<double>(cells.visible) / static_cast<double>(cells.visible + cells.hidden + cells.undecided);
  }

  test::TemporaryDirectory directory_;
  std::string path_ = directory_.file("t.itin");
};

TEST_F(VisibilityIndexTest, AgreesWithViewshedsWithinItsStandardError) {
  const test::CardiffTerrain terrain;
  import_posts([&](int c, int r) { return std::hypot(c - 60, r - 20) < 6 ? std::nan("") : terrain(c + 200, r + 150); });
  const IndexRequest request{.area = Window::box({301000, 197000, 303000, 199000}),
                             .cell_size = 250,
                             .height = 10,
                             .target_height = 2,
                             .radius = 1500,
                             .targets = 512};
  const VisibilityIndex result = index(request);
  ASSERT_EQ(result.grid.cell_count(), 64U);
  double squared = 0, mean = 0;
  std::uint64_t compared = 0;
  for (std::int64_t row = 0; row < 8; ++row) {
    for (std::int64_t column = 0; column < 8; ++column) {
      const std::size_t cell = result.grid.index({column, row});
      if (std::isnan(result.share[cell])) continue;  // in the void
      const double truth = share_seen(result.grid.centre(column, row), request);
      const double errors = (result.share[cell] - truth) / result.standard_error[cell];
      EXPECT_LT(std::abs(errors), 5) << column << ' ' << row;
      squared += errors * errors;
      mean += truth;
      ++compared;
    }
  }
  EXPECT_EQ(compared, result.observers);
  EXPECT_LT(compared, 64U);
  // The stated error is the error: neither too small nor so large that it says nothing.
  EXPECT_NEAR(squared / static_cast<double>(compared), 1, 0.6);
  EXPECT_NEAR(result.mean, mean / static_cast<double>(compared), 5 * result.mean_error);
}

TEST_F(VisibilityIndexTest, ThreadsAndNeighboursDoNotMatter) {
  const test::CardiffTerrain terrain;
  import_posts([&](int c, int r) { return terrain(c + 200, r + 150); });
  IndexRequest request{.area = Window::box({301000, 197000, 303000, 199000}), .cell_size = 500, .radius = 1000};
  set_thread_count(1);
  const VisibilityIndex one = index(request);
  set_thread_count(0);
  EXPECT_EQ(index(request).share, one.share);
  request.area = Window::box({301000, 198500, 301500, 199000});
  EXPECT_EQ(index(request).share.at(0), one.share.at(0));
  request.targets = 100;
  const float by_targets = index(request).share.at(0);
  request.area = Window::box({301000, 197000, 303000, 199000});
  EXPECT_EQ(index(request).share.at(0), by_targets);
}

TEST_F(VisibilityIndexTest, BlocksMakeTheWhole) {
  import_hills();
  IndexRequest request{.area = Window::box({300500, 196500, 303500, 199500}), .cell_size = 150, .radius = 700};
  for (const NoData rule : {NoData::kUnknown, NoData::kClear, NoData::kBlock}) {
    request.nodata = rule;
    // By rays, and by targets at random over posts.
    request.targets.reset();
    expect_blocks_make_the_whole(request, {60000, 40000});
    request.targets = 128;
    expect_blocks_make_the_whole(request, {40000, 22000});
  }
  // At a tolerance the surface is no lattice; nor is it where houses stand.
  request.detail = Detail::tolerance(1);
  expect_blocks_make_the_whole(request, {1000000, 300000});
  import_houses();
  request.detail = Detail::tolerance(0);
  request.themes = ThemeChoice::all();
  for (const NoData rule : {NoData::kUnknown, NoData::kClear, NoData::kBlock}) {
    request.nodata = rule;
    expect_blocks_make_the_whole(request, {2000000, 800000});
  }
  // Many lines, which rays look for first; an area that is no box.
  request.targets = 1000;
  request.area = Window::polygons({{{{300600, 196600}, {303200, 197000}, {301500, 199400}}, {}}});
  expect_blocks_make_the_whole(request, {1600000});
}

TEST_F(VisibilityIndexTest, LinesAreThoseOfViewshedsAndLinesOfSight) {
  import_hills();
  IndexRequest request{.area = Window::all(), .height = 4, .radius = 1500, .targets = 200};
  const auto expect_under_each_rule = [&] {
    for (const NoData rule : {NoData::kUnknown, NoData::kBlock, NoData::kClear}) {
      request.nodata = rule;
      expect_lines_of_viewsheds(request);
    }
  };
  expect_under_each_rule();
  import_houses();
  request.themes = ThemeChoice::all();
  expect_under_each_rule();
}

TEST_F(VisibilityIndexTest, RaysFindNothingElse) {
  import_hills();
  import_houses();
  NoProgress progress;
  const RetrievedSurface surface{
      triangulate(Store(path_), Window::all(), Detail::tolerance(0), progress, ThemeChoice::all()), nullptr, {}};
  const Earth earth;
  const LineTester few(surface, earth, 0), many(surface, earth, std::uint64_t{1} << 40);
  const VisibilitySampler one(few, few, {1500, 0, 4000}, NoData::kClear),
      other(many, many, {1500, 0, 4000}, NoData::kClear);
  for (const Point2 eye : {Point2{301500, 197900}, {302225, 198725}, {301225, 197225}}) {
    ASSERT_TRUE(one.ground(eye) && other.ground(eye));
    std::vector<Verdict> seen, seen_too;
    one.observe(eye, *one.ground(eye) + 3, 1, [&](Point2, Verdict v) { seen.push_back(v); });
    other.observe(eye, *other.ground(eye) + 3, 1, [&](Point2, Verdict v) { seen_too.push_back(v); });
    EXPECT_EQ(seen, seen_too);
  }
}

TEST_F(VisibilityIndexTest, TooLittleMemoryForOneObserverIsRefused) {
  import_hills();
  try {
    index({.area = Window::box({301000, 197000, 303000, 199000}), .radius = 1500, .memory_bytes = 10000});
    FAIL();
  } catch (const InputError& error) {
    for (const char* field : {"`memory_bytes`", "`radius`", "`tolerance`"})
      EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
  }
}

TEST_F(VisibilityIndexTest, EverythingIsSeenOnAPlaneAndNothingSaysSoForCertain) {
  import_posts([](int, int) { return 50.0; });
  IndexRequest request{.area = Window::box({301000, 197000, 303000, 199000}), .cell_size = 500, .radius = 500};
  request.earth.curvature = false;
  const VisibilityIndex result = index(request);
  for (const float share : result.share) EXPECT_EQ(share, 1);
  for (const float error : result.standard_error) EXPECT_GT(error, 0);
  EXPECT_GT(result.sample.rays, 0U);
  request.targets = 50;
  for (const float error : index(request).standard_error) EXPECT_GT(error, 0.01F);
}

TEST_F(VisibilityIndexTest, WrongCallsAreRefused) {
  import_posts([](int, int) { return 50.0; });
  EXPECT_THROW(index({.area = Window::box({0, 0, 10, 10})}), InputError);
  EXPECT_THROW(index({.area = Window::all(), .cell_size = 0}), InputError);
  EXPECT_THROW(index({.area = Window::box({301000, 197000, 301010, 197010}), .cell_size = 30000}), InputError);
}

}  // namespace
}  // namespace itin::viewshed
