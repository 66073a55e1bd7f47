// The progress that stages report only grows and ends at 1, on any number of threads.
#include "progress/stage.hpp"

#include <atomic>

#include <gtest/gtest.h>

#include "support/told_progress.hpp"

namespace itin::viewshed {
namespace {

TEST(Stage, OnlyGrowsAndReachesOne) {
  for (const std::size_t steps : {0, 1, 7, 1000, 123457}) {
    test::ToldProgress progress;
    std::atomic<std::size_t> sum = 0;
    for_each_step(steps, "work", progress, [&](std::size_t i) { sum += i + 1; });
    EXPECT_EQ(sum, steps * (steps + 1) / 2);
    progress.expect_whole("work");
    EXPECT_LE(progress.of("work").size(), 1001U);
  }
}

TEST(Stage, IsOfSeveralLoopsAndOfWhatIsLeftOut) {
  test::ToldProgress progress;
  Stage stage("work", 100, progress);
  stage.for_each(10, [](std::size_t) { return std::size_t{3}; });
  stage.advance_to(50);
  stage.advance_to(40);
  EXPECT_EQ(progress.of("work").back(), 0.5);
  stage.for_each(5, [](std::size_t i) { return 4 * i; });
  EXPECT_EQ(progress.of("work").back(), 0.9);
  stage.advance(10);
  progress.expect_whole("work");
}

TEST(Stage, EndsWhereTheCallIsCancelled) {
  class Stop final : public Progress {
   public:
    void report(std::string_view, double) override {}
    bool cancelled() const override { return true; }
  } stop;
  EXPECT_THROW(for_each_step(1, "work", stop, [](std::size_t) {}), Cancelled);
}

}  // namespace
}  // namespace itin::viewshed
