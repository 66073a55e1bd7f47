// The visibility index against whole viewsheds of single observers.
#include <cmath>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/parallel.hpp>
#include <viewshed/visibility_index.hpp>

#include "support/raster_file.hpp"
#include "support/real_terrain.hpp"
#include "support/temporary_directory.hpp"

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

  VisibilityIndex index(const IndexRequest& request) const {
    NoProgress progress;
    return visibility_index(Store(path_), request, progress);
  }

  /// Of the ground within the radius of one place, by a cell every 10 m.
  double share_seen(Point2 place, const IndexRequest& request) const {
    Request look;
    look.observers = {{"o", place, request.height}};
    look.target_height = request.target_height;
    look.radius = request.radius;
    look.cell_size = 10;
    look.nodata = request.nodata;
    NoProgress progress;
    const CellCounts cells = compute(Store(path_), look, progress).cells;
    return static_cast<double>(cells.visible) / static_cast<double>(cells.visible + cells.hidden);
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
}

TEST_F(VisibilityIndexTest, EverythingIsSeenOnAPlaneAndNothingSaysSoForCertain) {
  import_posts([](int, int) { return 50.0; });
  IndexRequest request{.area = Window::box({301000, 197000, 303000, 199000}), .cell_size = 500, .radius = 500};
  request.earth.curvature = false;
  const VisibilityIndex result = index(request);
  for (const float share : result.share) EXPECT_EQ(share, 1);
  for (const float error : result.standard_error) EXPECT_GT(error, 0);
}

TEST_F(VisibilityIndexTest, WrongCallsAreRefused) {
  import_posts([](int, int) { return 50.0; });
  EXPECT_THROW(index({.area = Window::box({0, 0, 10, 10})}), InputError);
  EXPECT_THROW(index({.area = Window::all(), .cell_size = 0}), InputError);
  EXPECT_THROW(index({.area = Window::all(), .nodata = NoData::kUnknown}), InputError);
  EXPECT_THROW(index({.area = Window::box({301000, 197000, 301010, 197010}), .cell_size = 30000}), InputError);
}

}  // namespace
}  // namespace itin::viewshed
