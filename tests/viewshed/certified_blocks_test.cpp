// What the blocks of a coarse level hide, against the full surface and its exact answer.
#include <utility>

#include <gtest/gtest.h>

#include <itin/level_choice.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/result.hpp>

#include "bounds/binned_heights.hpp"
#include "bounds/envelope_bounds.hpp"
#include "certify/level_source.hpp"
#include "support/full_detail.hpp"
#include "support/hills_with_gap.hpp"
#include "window/envelope.hpp"

namespace itin::viewshed {
namespace {

class CertifiedBlocks : public test::HillsWithGap {
 protected:
  static Request request_from(Point2 position) {
    Request request = HillsWithGap::request_from(position, 40);
    request.target_height = 10;
    request.cell_size = 31;
    return request;
  }

  /// Returns the share of the cells in view that the level decides.
  double expect_nothing_wrong(Request request, double tolerance) {
    const Result exact = test::compute_at_full_detail(*store_, request, {}, progress_).result;
    request.detail = Detail::tolerance(tolerance);
    const Result blocks = certify_by_blocks(*store_, request, {}, progress_).result;
    EXPECT_EQ(blocks.visible.size(), exact.visible.size());
    CellCounts cells;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < exact.visible.size(); ++i) {
      const Verdict value = blocks.visible[i];
      // The level may not know the elevation angle well enough.
      wrong += value == Verdict::kUndecided ? exact.visible[i] == Verdict::kOutside && !request.elevation
                                            : value != exact.visible[i];
      ++(value == Verdict::kOutside     ? cells.outside
         : value == Verdict::kUndecided ? cells.undecided
         : value == Verdict::kVisible   ? cells.visible
                                        : cells.hidden);
    }
    EXPECT_EQ(wrong, 0U) << "tolerance " << tolerance;
    EXPECT_EQ(blocks.cells.visible, cells.visible);
    EXPECT_EQ(blocks.cells.hidden, cells.hidden);
    EXPECT_EQ(blocks.cells.undecided, cells.undecided);
    EXPECT_EQ(blocks.cells.outside, cells.outside);
    return static_cast<double>(cells.visible + cells.hidden) /
           static_cast<double>(std::max<std::uint64_t>(1, exact.cells.visible + exact.cells.hidden));
  }
};

TEST_F(CertifiedBlocks, AreNeverWrong) {
  for (const double void_radius : {0.0, 25.0}) {
    make(void_radius);
    double decided = 0;
    for (const NoData rule : {NoData::kClear, NoData::kBlock, NoData::kUnknown}) {
      for (const double tolerance : {2.0, 8.0, 32.0}) {
        Request request = request_from(on_the_hills());
        request.nodata = rule;
        decided += expect_nothing_wrong(request, tolerance) / 9;
      }
    }
    EXPECT_GT(decided, 0.1);
  }
}

TEST_F(CertifiedBlocks, KeepToFieldsOfView) {
  make(0);
  in_fields_of_view(request_from(kBetweenPosts), [&](const Request& request) { expect_nothing_wrong(request, 8); });
}

TEST_F(CertifiedBlocks, OfSeveralObserversAgree) {
  make(0);
  Request request = request_from(on_the_hills());
  add_observers(request);
  expect_nothing_wrong(request, 8);
  request.earth = Earth::flat();
  expect_nothing_wrong(request, 8);
}

TEST_F(CertifiedBlocks, TakeCellsOfAllSizes) {
  make(0);
  in_cells_of_all_sizes(request_from(kOnPost), [&](const Request& request) { expect_nothing_wrong(request, 16); });
}

/// What the class promises, at random places.
TEST_F(CertifiedBlocks, EnclosedHeightsAreWithinTheirBounds) {
  make(20);
  for (const auto& [surface, bin] : {std::pair(0, 7.0), {0, 60.0}, {0, 333.0}, {1, 60.0}, {2, 60.0}, {2, 7.0}}) {
    const Tin enclosed = triangulate(*store_, Window::all(), detail_of(store_->metadata(), surface), progress_);
    const BinnedHeights heights(enclosed);
    const Box all = enclosed.bounds();
    EnvelopeRequest wanted;
    wanted.level = static_cast<int>(store_->metadata().levels.size()) - 2;
    wanted.surface = surface;
    const Point2 middle = anywhere();
    wanted.discs = {{middle, 400, surface}, {middle, 900, 2}};
    const Envelope envelope = envelop(*store_, wanted, progress_);
    const Box box{all.xmin - 100, all.ymin + 500, all.xmax - 700, all.ymax + 100};
    const EnvelopeBounds bounds(envelope.lower, envelope.upper, envelope.outline, box, bin);
    const auto lines = bounds.runs().eastwards();
    std::size_t covered = 0, bare = 0;
    for (int i = 0; i < 20000; ++i) {
      const Point2 p = anywhere();
      const double x = (p.x - bounds.units().origin.x) / bounds.units().resolution,
                   y = (p.y - bounds.units().origin.y) / bounds.units().resolution;
      const double column = bounds.column_at(x), row = bounds.row_at(y);
      if (column < 0 || row < 0 || column >= static_cast<double>(bounds.columns()) ||
          row >= static_cast<double>(bounds.rows()))
        continue;
      const BinBox place{column, row, column, row};
      const std::optional<double> height = heights.height_at({x, y});
      if (!height) {
        ++bare;
        ASSERT_FALSE(bounds.covers(place));
        continue;
      }
      const auto run = static_cast<std::int64_t>(column) / RunBounds::kRun, line = static_cast<std::int64_t>(row);
      ASSERT_LE(lines.low(run, line), *height + 1e-3);
      ASSERT_GE(lines.high(run, line), *height - 1e-3);
      ASSERT_GE(bounds.highest(place), *height - 1e-3);
      ASSERT_GE(bounds.highest({column - 1, row - 2, column + 3, row}), *height - 1e-3);
      covered += bounds.covers(place) ? 1 : 0;
    }
    EXPECT_GT(covered, bin < 100 ? 5000U : 100U);
    EXPECT_GT(bare, 10U);
  }
}

}  // namespace
}  // namespace itin::viewshed
