// The loop over segments takes each in its order, and their progress grows as their efforts do.
#include "run/segments.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "progress/stage.hpp"
#include "support/told_progress.hpp"

namespace itin::viewshed {
namespace {

TEST(Segments, TakeTheirPartsOfTheWhole) {
  const std::vector<Effort> efforts{{1, 3}, {4, 0}, {0, 2}};
  test::ToldProgress progress;
  std::vector<double> reached;
  for_each_segment(
      efforts, [](const Effort& effort) { return effort; }, progress,
      [&](const Effort&, SegmentProgress& of_segment) {
        for_each_step(2, "reading", of_segment.reading(), [](std::size_t) {});
        reached.push_back(progress.all().back());
        for_each_step(2, "judging", of_segment.judging(), [](std::size_t) {});
        reached.push_back(progress.all().back());
      });
  const std::vector<double> expected{1, 4, 8, 8, 8, 10};
  ASSERT_EQ(reached.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(reached[i], expected[i] / 10, 1e-12) << i;
  progress.expect_whole_call();
}

TEST(Segments, ReadInShares) {
  test::ToldProgress progress;
  SegmentProgress segment({6, 4}, progress);
  std::vector<double> reached;
  for (const double share : {0.5, 0.5, 1.0}) {
    for_each_step(1, "reading", segment.reading(share), [](std::size_t) {});
    reached.push_back(progress.all().back());
  }
  EXPECT_NEAR(reached[0], 0.3, 1e-12);
  EXPECT_NEAR(reached[1], 0.45, 1e-12);
  EXPECT_NEAR(reached[2], 0.6, 1e-12);
}

TEST(Segments, EndWhereNothingIsToBeDone) {
  test::ToldProgress progress;
  for_each_segment(
      std::vector<Effort>{}, [](const Effort& effort) { return effort; }, progress,
      [](const Effort&, SegmentProgress&) { FAIL(); });
  progress.expect_whole_call();
  for_each_segment(
      std::vector<Effort>(2), [](const Effort& effort) { return effort; }, progress,
      [](const Effort&, SegmentProgress&) {});
}

TEST(Segments, EndBetweenTwoWhenTheCallIsCancelled) {
  struct Stop final : Progress {
    void report(std::string_view, double) override {}
    bool cancelled() const override { return stop; }
    bool stop = false;
  } progress;
  int taken = 0;
  const auto take = [&](const Effort&, SegmentProgress&) { progress.stop = ++taken == 2; };
  EXPECT_THROW(for_each_segment(
                   std::vector<Effort>(5), [](const Effort& effort) { return effort; }, progress, take),
               Cancelled);
  EXPECT_EQ(taken, 2);
}

}  // namespace
}  // namespace itin::viewshed
