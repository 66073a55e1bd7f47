// A surface that is held gives what the store gives, to any number of callers.
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <viewshed/held_surface.hpp>

#include "support/hills_and_town.hpp"
#include "support/impatient.hpp"
#include "support/same_result.hpp"
#include "support/seed.hpp"

namespace itin::viewshed {
namespace {

class HeldSurfaces : public testing::Test {
 protected:
  static void SetUpTestSuite() { stores_ = new test::HillsAndTown; }
  static void TearDownTestSuite() {
    delete stores_;
    stores_ = nullptr;
  }

  /// One observer somewhere in the middle of the box, who looks `radius` metres far.
  Request look_within(const Box& box, double radius, Request request) {
    std::uniform_real_distribution<double> along(0, 1);
    const auto in = [&](double low, double high) { return low + radius + along(random_) * (high - low - 2 * radius); };
    request.observers = {{"o", {in(box.xmin, box.xmax), in(box.ymin, box.ymax)}, 20 * along(random_)}};
    request.radius = radius;
    return request;
  }

  static inline test::HillsAndTown* stores_ = nullptr;
  std::mt19937 random_{test::seed()};
  NoProgress progress_;
};

TEST_F(HeldSurfaces, GiveWhatTheStoreGives) {
  const Store store(stores_->hills());
  const Box area{301500, 200200, 303800, 203800};
  for (const Detail& detail : {Detail::tolerance(0), Detail::tolerance(3)}) {
    const HeldSurface surface(store, area, detail, ThemeChoice::all(), {}, progress_);
    for (const Mode mode : test::kEveryMode) {
      SCOPED_TRACE(static_cast<int>(mode));
      Request request = look_within(area, 700, test::HillsAndTown::over_hills());
      request.mode = mode;
      request.detail = detail;
      request.cell_size = 17;
      const Result whole = compute(store, request, progress_);
      EXPECT_GT(whole.cells.visible, 20U);
      test::expect_same_result(whole, surface.compute(request, progress_));
    }
  }
}

TEST_F(HeldSurfaces, HoldFeatures) {
  const Store store(stores_->town());
  const Box area{321600, 4297550, 322000, 4297900};
  const HeldSurface surface(store, area, Detail::tolerance(0), ThemeChoice::all(), {}, progress_);
  for (const Mode mode : test::kEveryMode) {
    for (const bool on_surface : {false, true}) {
      SCOPED_TRACE(static_cast<int>(mode));
      Request request = look_within(area, 120, test::HillsAndTown::over_town());
      request.mode = mode;
      request.targets_on_surface = request.observers_on_surface = on_surface;
      test::expect_same_result(compute(store, request, progress_), surface.compute(request, progress_));
    }
  }
}

TEST_F(HeldSurfaces, ServeSeveralThreads) {
  const Store store(stores_->hills());
  const Box area{301600, 200000, 304000, 204000};  // no hole in it
  const HeldSurface surface(store, area, Detail::tolerance(0), ThemeChoice::none(), {}, progress_);
  std::vector<Request> requests;
  std::vector<Result> expected, found(24);
  for (std::size_t i = 0; i < found.size(); ++i) {
    requests.push_back(look_within(area, 600, test::HillsAndTown::over_hills()));
    requests.back().mode = test::kEveryMode[i % std::size(test::kEveryMode)];
    expected.push_back(compute(store, requests.back(), progress_));
  }
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      NoProgress progress;
      for (std::size_t i = t; i < found.size(); i += 4) found[i] = surface.compute(requests[i], progress);
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE(i);
    test::expect_same_result(expected[i], found[i]);
  }
}

/// What finds triangles along lines is kept between calls, but never half made.
TEST_F(HeldSurfaces, FindTrianglesAfterACancelledCall) {
  const Store store(stores_->town());
  const HeldSurface surface(store, {321600, 4297550, 322000, 4297900}, Detail::tolerance(0), ThemeChoice::all(), {},
                            progress_);
  for (const Mode mode : {Mode::kBlocker, Mode::kLoss}) {
    Request request =
        look_within(surface.area(), 120, test::HillsAndTown::in_mode(mode, test::HillsAndTown::over_town()));
    for (const int looks : {0, 3, 10, 20, 40}) {
      test::Impatient impatient(looks);
      EXPECT_THROW(std::ignore = surface.compute(request, impatient), Cancelled);
    }
    test::expect_same_result(compute(store, request, progress_), surface.compute(request, progress_));
  }
}

TEST_F(HeldSurfaces, RefuseWhatTheyDoNotHold) {
  const Store store(stores_->hills());
  const Box area{301000, 201000, 303000, 203000};
  const HeldSurface surface(store, area, Detail::tolerance(0), ThemeChoice::none(), {}, progress_);
  Request request;
  request.observers = {{"o", {302000, 202000}, 10}};
  request.radius = 900;
  EXPECT_TRUE(surface.covers(request));
  request.radius = 1100;
  EXPECT_FALSE(surface.covers(request));
  EXPECT_THROW(std::ignore = surface.compute(request, progress_), InputError);
  request.radius.reset();
  EXPECT_FALSE(surface.covers(request));
  EXPECT_THROW(HeldSurface(store, area, Detail::tolerance(0), ThemeChoice::none(), {.memory_bytes = 1000}, progress_),
               InputError);
  EXPECT_THROW(HeldSurface(store, Box(), Detail::tolerance(0), ThemeChoice::none(), {}, progress_), InputError);

  // Beyond the data there is nothing to hold.
  const HeldSurface all(store, {0, 0, 1000000, 1000000}, Detail::tolerance(0), ThemeChoice::none(), {}, progress_);
  EXPECT_TRUE(all.covers(request));
  test::expect_same_result(compute(store, request, progress_), all.compute(request, progress_));
}

}  // namespace
}  // namespace itin::viewshed
