// Viewsheds at a tolerance that read no more ground than may be seen, against those of the whole surface.
#include <tuple>

#include <gtest/gtest.h>

#include <viewshed/result.hpp>

#include "exact/store_viewshed.hpp"
#include "exact/tin_segments.hpp"
#include "support/hills_with_gap.hpp"
#include "support/raster_file.hpp"
#include "support/same_result.hpp"

namespace itin::viewshed {
namespace {

constexpr std::uint64_t kAmple = 1000000000;

class SeenGround : public test::HillsWithGap {
 protected:
  static Request request_from(Point2 position, double height) {
    Request request = HillsWithGap::request_from(position, height);
    request.target_height = 2;
    request.cell_size = 23;
    return request;
  }

  /// Adds up how many triangles of the whole surface were read.
  void expect_the_whole_answer(const Request& request, std::uint64_t memory = kAmple) {
    ASSERT_TRUE(reads_what_may_be_seen(*store_, request));
    const Result whole = compute_over_tin(*store_, request, {}, progress_).result;
    const Result seen = compute_in_tin_segments(*store_, request, memory, {}, progress_).result;
    test::expect_same_result(whole, seen);
    triangles_ += static_cast<double>(whole.statistics.triangles);
    read_ += static_cast<double>(seen.statistics.triangles);
  }

  double triangles_ = 0, read_ = 0;
};

TEST_F(SeenGround, GivesTheAnswerOfTheWhole) {
  for (const auto& [gap, roughness, sea] : {std::tuple(0.0, 0.6, -1000.0), {25.0, 0.6, 20.0}, {0.0, 0.9, -1000.0}}) {
    make(gap, roughness, sea);
    for (const double tolerance : {0.5, 2.0, 8.0, 32.0}) {
      for (const NoData rule : {NoData::kClear, NoData::kBlock, NoData::kUnknown}) {
        Request request = request_from(on_the_hills(), rule == NoData::kBlock ? 2 : 30);
        request.detail = Detail::tolerance(tolerance);
        request.nodata = rule;
        expect_the_whole_answer(request);
      }
    }
  }
}

TEST_F(SeenGround, KeepsToFieldsOfViewAndTargets) {
  make(0, 0.7);
  Request request = request_from(kBetweenPosts, 10);
  request.detail = Detail::tolerance(2);
  request.target_height = 0;
  expect_the_whole_answer(request);
  request.target_height = 60;
  expect_the_whole_answer(request);
  request = in_fields_of_view(request, [&](const Request& narrower) { expect_the_whole_answer(narrower); });
  request.earth = Earth::flat();
  expect_the_whole_answer(request);
}

TEST_F(SeenGround, TakesPostsAndCellsOfAllSizes) {
  make(0, 0.7);
  Request request = request_from(kOnPost, 5);
  request.detail = Detail::tolerance(4);
  in_cells_of_all_sizes(request, [&](const Request& of_size) { expect_the_whole_answer(of_size); });
}

TEST_F(SeenGround, CountsForSeveralObserversInLittleMemory) {
  make(20, 0.7);
  for (const Mode mode : {Mode::kVisible, Mode::kCount, Mode::kWhich, Mode::kNearest}) {
    Request request = request_from(on_the_hills(), 20);
    request.mode = mode;
    request.detail = Detail::tolerance(1);
    add_observers(request);
    expect_the_whole_answer(request, 4000000);
  }
}

TEST_F(SeenGround, IsLeftToModesThatAskNoMore) {
  make(0, 0.7);
  Request request = request_from(on_the_hills(), 20);
  EXPECT_FALSE(reads_what_may_be_seen(*store_, request)) << "full detail has certificates";
  request.detail = Detail::tolerance(2);
  EXPECT_TRUE(reads_what_may_be_seen(*store_, request));
  for (const Mode mode : {Mode::kHeight, Mode::kAngle, Mode::kBlocker, Mode::kProbability}) {
    request.mode = mode;
    EXPECT_FALSE(reads_what_may_be_seen(*store_, request));
  }
}

TEST_F(SeenGround, OfRealHillsIsLittle) {
  const test::CardiffTerrain heights;
  import_posts([&](int c, int r) { return heights(c + 300, r + 300); });
  for (const double east : {1000.0, 2600.0, 4200.0}) {
    for (const double south : {1000.0, 2600.0, 4200.0}) {
      Request request = request_from({kFirstEast + east, kFirstNorth - south}, 2);
      request.detail = Detail::tolerance(0.5);
      expect_the_whole_answer(request);
    }
  }
  EXPECT_LT(read_, 0.7 * triangles_);
}

}  // namespace
}  // namespace itin::viewshed
