// A paged surface gives what the store gives, wherever its observers go and whatever it holds meanwhile.
#include <atomic>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <viewshed/held_surface.hpp>
#include <viewshed/surface.hpp>

#include "support/hills_and_town.hpp"
#include "support/same_result.hpp"
#include "support/seed.hpp"

namespace itin::viewshed {
namespace {

class PagedSurfaces : public testing::Test {
 protected:
  static void SetUpTestSuite() { stores_ = new test::HillsAndTown; }
  static void TearDownTestSuite() {
    delete stores_;
    stores_ = nullptr;
  }

  static Request from(Point2 position, double radius) {
    Request request = test::HillsAndTown::over_hills();
    request.observers = {{"walker", position, 5}};
    request.radius = radius;
    return request;
  }
  /// From one corner of the hills to the other, past their hole and their edge.
  static Point2 step(std::size_t i, std::size_t steps) {
    const double share = static_cast<double>(i) / static_cast<double>(steps);
    return {300100 + 3800 * share, 200300 + 3600 * share * share};
  }
  /// Enough for a surface of so many points.
  static ComputeOptions triangles_of(std::uint64_t points) { return {.memory_bytes = 400 * points, .lattices = false}; }

  static inline test::HillsAndTown* stores_ = nullptr;
  std::mt19937 random_{test::seed()};
  NoProgress progress_;
};

TEST_F(PagedSurfaces, FollowAnObserver) {
  const Store store(stores_->hills());
  for (const bool lattices : {true, false}) {
    PagedSurface pages(store, Detail::tolerance(0), ThemeChoice::none(), {.lattices = lattices});
    constexpr std::size_t kSteps = 60;
    for (std::size_t i = 0; i < kSteps; ++i) {
      SCOPED_TRACE(i);
      Request request = from(step(i, kSteps), 400);
      request.mode = test::kEveryMode[i % std::size(test::kEveryMode)];
      request.nodata = i % 3 == 0 ? NoData::kUnknown : i % 3 == 1 ? NoData::kBlock : NoData::kClear;
      test::expect_same_result(compute(store, request, progress_), pages.compute(request, progress_));
    }
    // A small movement reads nothing.
    EXPECT_GT(pages.readings(), 5U);
    EXPECT_LT(pages.readings(), lattices ? 2 * kSteps / 3 : kSteps / 3);
    EXPECT_EQ(pages.areas().size(), pages.readings());
  }
}

TEST_F(PagedSurfaces, TakeInFeaturesAndTolerances) {
  const Store store(stores_->town());
  for (const double tolerance : {0.0, 1.0}) {
    PagedSurface pages(store, Detail::tolerance(tolerance), ThemeChoice::all());
    for (std::size_t i = 0; i < 12; ++i) {
      SCOPED_TRACE(i);
      Request request = test::HillsAndTown::over_town();
      request.observers = {{"o", {321650 + 20.0 * static_cast<double>(i), 4297600 + 15.0 * static_cast<double>(i)}, 3}};
      request.radius = 60;
      request.detail = Detail::tolerance(tolerance);
      request.mode = test::kEveryMode[i % std::size(test::kEveryMode)];
      request.targets_on_surface = i % 2 == 0;
      if (i % 3 == 0 && request.mode != Mode::kHeight) request.engine = Engine::kRays;
      test::expect_same_result(compute(store, request, progress_), pages.compute(request, progress_));
    }
  }
}

/// The memory holds one area: every other one takes its place.
TEST_F(PagedSurfaces, DropWhatWasUsedLongestAgo) {
  const Store store(stores_->hills());
  const Request here = from({300700, 203000}, 300), there = from({303200, 200900}, 300);
  PagedSurface roomy(store, Detail::tolerance(0), ThemeChoice::none());
  PagedSurface tight(store, Detail::tolerance(0), ThemeChoice::none(), triangles_of(3400));
  const Result at_here = compute(store, here, progress_), at_there = compute(store, there, progress_);
  for (int round = 0; round < 3; ++round) {
    for (PagedSurface* const pages : {&roomy, &tight}) {
      test::expect_same_result(at_here, pages->compute(here, progress_));
      test::expect_same_result(at_there, pages->compute(there, progress_));
    }
    ASSERT_EQ(tight.areas().size(), 1U);
    EXPECT_TRUE(tight.areas().front().contains({303200, 200900}));
  }
  EXPECT_EQ(tight.readings(), 6U);
  EXPECT_EQ(roomy.readings(), 2U);
  ASSERT_EQ(roomy.areas().size(), 2U);
  EXPECT_TRUE(roomy.areas().front().contains({303200, 200900}));
}

/// An area that is no larger than the request, where the memory holds no larger one.
TEST_F(PagedSurfaces, HoldWhatTheyCan) {
  const Store store(stores_->hills());
  const Request request = from({302900, 201200}, 1000);
  const auto area_within = [&](std::uint64_t points) {
    PagedSurface pages(store, Detail::tolerance(0), ThemeChoice::none(), triangles_of(points));
    test::expect_same_result(compute(store, request, progress_), pages.compute(request, progress_));
    const std::vector<Box> areas = pages.areas();
    return areas.empty() ? 0 : areas.front().width();
  };
  const double all = area_within(100000);
  EXPECT_GT(all, 2000 * 1.25);
  EXPECT_LT(all, 2000 * 2);
  const std::uint64_t points = 11 * store.points_about(0, {301900, 200200, 303900, 202200}) / 10;
  const double least = area_within(points);
  EXPECT_GE(least, 2000);
  EXPECT_LT(least, all);
  EXPECT_EQ(area_within(points / 2), 0);  // from the store, in segments
}

TEST_F(PagedSurfaces, ComputeFromTheStoreWhatTheMemoryDoesNotHold) {
  const Store store(stores_->hills());
  PagedSurface pages(store, Detail::tolerance(0), ThemeChoice::none(), triangles_of(8000));
  const Request near = from({303000, 201000}, 300);
  std::ignore = pages.compute(near, progress_);
  EXPECT_EQ(pages.areas().size(), 1U);
  Request far = from({303000, 201000}, 300);
  far.radius.reset();
  far.mode = Mode::kCount;
  const Result whole = compute(store, far, progress_);
  EXPECT_GT(whole.cells.visible, 1000U);
  test::expect_same_result(whole, pages.compute(far, progress_));
  EXPECT_EQ(pages.areas().size(), 1U);
  test::expect_same_result(compute(store, near, progress_), pages.compute(near, progress_));
  EXPECT_EQ(pages.readings(), 1U);
}

/// Half of the memory is enough, or all of it: a request that a store answers within the memory is answered.
TEST_F(PagedSurfaces, AnswerWhatTheStoreAnswersWithAllMemory) {
  const Store store(stores_->hills());
  Request far = from({303000, 201000}, 300);
  far.radius.reset();
  far.cell_size = 50;
  int with_half = 0;
  for (std::uint64_t points = 200; points < 8000; points *= 2) {
    SCOPED_TRACE(points);
    ComputeOptions options = triangles_of(points);
    options.whole_surface = false;
    std::optional<Result> whole;
    try {
      whole = compute_with_surface(store, far, options, progress_).result;
    } catch (const InputError&) {
    }
    PagedSurface pages(store, Detail::tolerance(0), ThemeChoice::none(), options);
    std::ignore = pages.compute(from({303000, 201000}, 20), progress_);
    if (pages.areas().empty()) continue;
    if (!whole) {
      EXPECT_THROW(std::ignore = pages.compute(far, progress_), InputError);
      continue;
    }
    test::expect_same_result(*whole, pages.compute(far, progress_));
    with_half += pages.areas().empty() ? 0 : 1;
  }
  EXPECT_GT(with_half, 2);
}

TEST_F(PagedSurfaces, PrefetchWhatFitsBesideTheAreaUsedLast) {
  const Store store(stores_->hills());
  const Request here = from({300700, 203000}, 300), there = from({303200, 200900}, 300);
  const Box ahead{302900, 200600, 303500, 201200};
  PagedSurface roomy(store, Detail::tolerance(0), ThemeChoice::none());
  PagedSurface tight(store, Detail::tolerance(0), ThemeChoice::none(), triangles_of(3400));
  for (PagedSurface* const pages : {&roomy, &tight}) {
    std::ignore = pages->compute(here, progress_);
    pages->prefetch(ahead, progress_);
    pages->prefetch(ahead, progress_);
    pages->prefetch({0, 0, 1000, 1000}, progress_);  // beyond all data
  }
  EXPECT_EQ(roomy.readings(), 2U);
  test::expect_same_result(compute(store, there, progress_), roomy.compute(there, progress_));
  EXPECT_EQ(roomy.readings(), 2U);
  EXPECT_EQ(tight.readings(), 1U);
  EXPECT_EQ(tight.areas().size(), 1U);
}

TEST_F(PagedSurfaces, RefuseWhatTheStoreRefuses) {
  const Store store(stores_->hills());
  PagedSurface pages(store, Detail::tolerance(0), ThemeChoice::none());
  std::ignore = pages.compute(from({303000, 201000}, 300), progress_);
  for (const Point2 outside : {Point2{310000, 201000}, {301200, 201600}}) {  // beyond the data, and in their hole
    EXPECT_THROW(std::ignore = compute(store, from(outside, 200), progress_), InputError);
    EXPECT_THROW(std::ignore = pages.compute(from(outside, 200), progress_), InputError);
  }
  EXPECT_THROW(std::ignore = pages.compute(from({303000, 201000}, -1), progress_), InputError);
  EXPECT_GE(pages.areas().size(), 1U);
}

/// Threads that walk together through a memory that holds little.
TEST_F(PagedSurfaces, ServeSeveralThreads) {
  const Store store(stores_->hills());
  constexpr std::size_t kSteps = 40;
  std::vector<Result> expected(kSteps);
  std::vector<Request> requests;
  for (std::size_t i = 0; i < kSteps; ++i) {
    requests.push_back(from(step(i, kSteps), 350));
    requests.back().mode = i % 5 == 0 ? Mode::kBlocker : Mode::kVisible;
    expected[i] = compute(store, requests[i], progress_);
  }
  for (const std::uint64_t memory : {std::uint64_t{600000}, std::uint64_t{1} << 30}) {
    PagedSurface pages(store, Detail::tolerance(0), ThemeChoice::none(), {.memory_bytes = memory});
    std::vector<std::vector<Result>> found(4);
    std::vector<std::thread> threads;
    for (std::vector<Result>& results : found)
      threads.emplace_back([&] {
        NoProgress progress;
        for (const Request& request : requests) results.push_back(pages.compute(request, progress));
      });
    for (std::thread& thread : threads) thread.join();
    for (const std::vector<Result>& results : found)
      for (std::size_t i = 0; i < kSteps; ++i) test::expect_same_result(expected[i], results[i]);
    if (memory == std::uint64_t{1} << 30) {
      PagedSurface alone(store, Detail::tolerance(0), ThemeChoice::none());
      for (const Request& request : requests) std::ignore = alone.compute(request, progress_);
      EXPECT_EQ(pages.readings(), alone.readings());
    }
  }
}

/// Cancels itself once a stage is under way.
class Stopped final : public Progress {
 public:
  void report(std::string_view, double) override { begun_ = true; }
  bool cancelled() const override { return begun_; }

 private:
  std::atomic<bool> begun_ = false;
};

TEST_F(PagedSurfaces, ReadAgainAfterACancelledReading) {
  const Store store(stores_->hills());
  PagedSurface pages(store, Detail::tolerance(0), ThemeChoice::none());
  const Request request = from({303000, 201000}, 300);
  Stopped stopped;
  EXPECT_THROW(std::ignore = pages.compute(request, stopped), Cancelled);
  test::expect_same_result(compute(store, request, progress_), pages.compute(request, progress_));
  EXPECT_EQ(pages.areas().size(), 1U);
}

Result merged(const Plan& plan, const auto& decide_one) {
  Merge merge(plan);
  for (std::size_t i = plan.segments().size(); i-- > 0;) merge.add(i, decide_one(i));
  return merge.take();
}

TEST_F(PagedSurfaces, DecideSegmentsOfAPlan) {
  const Store store(stores_->hills());
  const HeldSurface held(store, extent_of(store), Detail::tolerance(0), ThemeChoice::none(), {}, progress_);
  PagedSurface pages(store, Detail::tolerance(0), ThemeChoice::none());
  PagedSurface tight(store, Detail::tolerance(0), ThemeChoice::none(), triangles_of(8000));
  for (const Mode mode : test::kEveryMode) {
    SCOPED_TRACE(static_cast<int>(mode));
    const Request request = test::HillsAndTown::in_mode(mode, test::HillsAndTown::over_hills());
    const Result whole = compute(store, request, progress_);
    const Plan plan(store, request, {}, 4096);
    EXPECT_GT(plan.segments().size(), 10U);
    test::expect_same_result(whole, merged(plan, [&](std::size_t i) { return decide(held, plan, i, progress_); }));
    test::expect_same_result(whole, merged(plan, [&](std::size_t i) { return decide(pages, plan, i, progress_); }));
    if (mode == Mode::kBlocker) {
      test::expect_same_result(whole, merged(plan, [&](std::size_t i) { return decide(tight, plan, i, progress_); }));
    }
  }
  // One area serves the whole plan: over posts, and over triangles.
  EXPECT_EQ(pages.readings(), 2U);
}

TEST_F(PagedSurfaces, DecideSegmentsOfACertifiedPlan) {
  const Store store(stores_->town());
  Request request = test::HillsAndTown::over_town();
  request.detail = Detail::tolerance(4);
  const Plan plan(store, request, {}, 6000, Certainty::kCertified);
  ASSERT_TRUE(plan.decides_exactly());
  PagedSurface pages(store, Detail::tolerance(0), ThemeChoice::all());
  const Result whole = compute_certified(store, request, {}, progress_).result;
  const Result parts = merged(plan, [&](std::size_t i) { return decide(pages, plan, i, progress_); });
  EXPECT_TRUE(parts.certified);
  test::expect_same_result(whole, parts);
  const Result segment = decide(pages, plan, 1, progress_);
  EXPECT_EQ(segment.request.detail.coarsest(), 4);
  EXPECT_TRUE(segment.certified);
}

TEST_F(PagedSurfaces, DecideTheirOwnPlansAlone) {
  const Store store(stores_->town());
  const Plan plan(store, test::HillsAndTown::over_town(), {}, 6000);
  PagedSurface coarse(store, Detail::tolerance(4), ThemeChoice::all());
  PagedSurface bare(store, Detail::tolerance(0), ThemeChoice::none());
  const HeldSurface elsewhere(store, {321600, 4297550, 321620, 4297560}, Detail::tolerance(0), ThemeChoice::all(), {},
                              progress_);
  EXPECT_THROW(std::ignore = decide(coarse, plan, 0, progress_), InputError);
  EXPECT_THROW(std::ignore = decide(bare, plan, 0, progress_), InputError);
  EXPECT_THROW(std::ignore = decide(elsewhere, plan, 0, progress_), InputError);
}

}  // namespace
}  // namespace itin::viewshed
