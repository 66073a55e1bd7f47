// What a sink gets of a viewshed while it is computed is what the result has in the end.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <viewshed/held_surface.hpp>
#include <viewshed/viewshed.hpp>

#include "certify/level_source.hpp"
#include "exact/lattice_sectors.hpp"
#include "exact/tin_segments.hpp"
#include "support/hills_and_town.hpp"
#include "support/same_bits.hpp"
#include "support/same_result.hpp"

namespace itin::viewshed {
namespace {

/// Keeps what blocks hold when they come.
class Received {
 public:
  CellSink sink() {
    return [this](const Result& result, const DecidedCells& block) { take(result, block); };
  }

  void expect_is(const Result& result) const {
    ASSERT_EQ(times_.size(), result.grid.cell_count());
    const auto* const heights = std::get_if<LeastHeights>(&result.values);
    for (std::size_t cell = 0; cell < times_.size(); ++cell) {
      ASSERT_LE(times_[cell], 1) << cell;
      ASSERT_EQ(times_[cell] == 1 ? verdicts_[cell] : Verdict::kOutside, result.visible[cell]) << cell;
      if (heights != nullptr && times_[cell] == 1) {
        ASSERT_TRUE(test::same_bits(heights_[cell], heights->height_m[cell])) << cell;
      }
    }
  }

  const std::vector<Point2>& corners() const { return corners_; }

 private:
  void take(const Result& result, const DecidedCells& block) {
    times_.resize(result.grid.cell_count()), verdicts_.resize(times_.size()), heights_.resize(times_.size());
    const auto* const heights = std::get_if<LeastHeights>(&result.values);
    for (std::int64_t row = 0; row < block.rows; ++row) {
      for (std::int64_t column = 0; column < block.columns; ++column) {
        const std::size_t cell = result.grid.index({block.north_west.column + column, block.north_west.row + row});
        ++times_[cell];
        verdicts_[cell] = result.visible[cell];
        if (heights != nullptr) heights_[cell] = heights->height_m[cell];
      }
    }
    const Box box = result.grid.part(block.north_west, block.columns, block.rows).bounds();
    const Point2 eye = result.request.observers.front().position;
    corners_.push_back({std::clamp(eye.x, box.xmin, box.xmax), std::clamp(eye.y, box.ymin, box.ymax)});
  }

  std::vector<int> times_;
  std::vector<Verdict> verdicts_;
  std::vector<float> heights_;
  std::vector<Point2> corners_;  ///< the place of each block that is nearest to the first observer
};

class CellSinks : public testing::Test {
 protected:
  static void SetUpTestSuite() { stores_ = new test::HillsAndTown; }
  static void TearDownTestSuite() {
    delete stores_;
    stores_ = nullptr;
  }

  /// Computes with a sink, and expects the result that comes without one.
  void expect_same(const Store& store, const Request& request, ComputeOptions options) {
    const Result without = compute_with_surface(store, request, options, progress_).result;
    Received received;
    options.sink = received.sink();
    const Result with = compute_with_surface(store, request, options, progress_).result;
    test::expect_same_result(without, with);
    received.expect_is(with);
  }

  static inline test::HillsAndTown* stores_ = nullptr;
  NoProgress progress_;
};

TEST_F(CellSinks, GetEveryCellOfEveryModeOnce) {
  const Store hills(stores_->hills()), town(stores_->town());
  for (const Mode mode : test::kEveryMode) {
    SCOPED_TRACE(static_cast<int>(mode));
    Request over_hills = test::HillsAndTown::in_mode(mode, test::HillsAndTown::over_hills()),
            over_town = test::HillsAndTown::in_mode(mode, test::HillsAndTown::over_town());
    over_hills.cell_size = 39, over_town.cell_size = 9;
    expect_same(hills, over_hills, {});
    expect_same(town, over_town, {});
  }
}

TEST_F(CellSinks, GetWhatIsDecidedPieceByPiece) {
  const Store hills(stores_->hills());
  const Request request = test::HillsAndTown::over_hills();
  const Result whole = compute(hills, request, progress_);
  Received by_sectors, by_segments, certified;
  const auto sectors = compute_by_lattice_sectors(hills, request, 800000, by_sectors.sink(), progress_);
  ASSERT_TRUE(sectors);
  test::expect_same_result(whole, sectors->result);
  by_sectors.expect_is(sectors->result);

  const Result segments = compute_in_tin_segments(hills, request, 8000000, by_segments.sink(), progress_).result;
  test::expect_same_result(whole, segments);
  by_segments.expect_is(segments);

  Request coarse = request;
  coarse.detail = Detail::tolerance(8);
  certified.expect_is(certify_by_blocks(hills, coarse, certified.sink(), progress_).result);
}

TEST_F(CellSinks, GetTheNearestCellsFirst) {
  const Store hills(stores_->hills());
  const HeldSurface surface(hills, {301500, 200200, 303800, 203800}, Detail::tolerance(0), ThemeChoice::none(), {},
                            progress_);
  Request request;
  request.observers = {{"o", {302650, 202000}, 10}};
  request.radius = 1100;
  request.cell_size = 5;
  const ThreadLimit one(1);
  Received received;
  received.expect_is(surface.compute(request, progress_, received.sink()));
  ASSERT_GT(received.corners().size(), 9U);
  double nearest = 0;
  for (const Point2& corner : received.corners()) {
    const double distance = std::hypot(corner.x - 302650, corner.y - 202000);
    EXPECT_GE(distance, nearest);
    nearest = distance;
  }
}

}  // namespace
}  // namespace itin::viewshed
