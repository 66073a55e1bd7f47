#include "program/time_left.hpp"

#include <gtest/gtest.h>

namespace itin::cli {

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const TimeLeft::Clock::time_point kStart{};

TEST(TimeLeft, SaysNothingUntilEnoughIsDone) {
  TimeLeft left;
  EXPECT_FALSE(left.after(0, kStart));
  EXPECT_FALSE(left.after(0.0001, kStart + seconds(2)));
  EXPECT_FALSE(left.after(0.5, kStart + milliseconds(600)));
  EXPECT_EQ(left.after(0.5, kStart + seconds(10)), seconds(10));
  EXPECT_FALSE(left.after(1, kStart + seconds(20)));
}

/// A slow beginning of four minutes.
TEST(TimeLeft, NeverSaysHoursInARunOfMinutes) {
  TimeLeft left;
  for (int t = 0; t <= 240; ++t) {
    const double fraction = t < 60 ? t * 0.001 : 0.06 + (t - 60) * 0.94 / 180;
    const auto said = left.after(fraction, kStart + seconds(t));
    EXPECT_LT(said.value_or(seconds(0)), seconds(20 * 60)) << t;
  }
}

TEST(TimeLeft, BeginsAnewWithAnotherCall) {
  TimeLeft left;
  left.after(0, kStart);
  left.after(1, kStart + seconds(100));
  EXPECT_FALSE(left.after(0, kStart + seconds(200)));
  EXPECT_EQ(left.after(0.25, kStart + seconds(210)), seconds(30));
}

TEST(TimeLeft, IsToldNoFinerThanItIsKnown) {
  EXPECT_EQ(about(seconds(12)), "12 s");
  EXPECT_EQ(about(seconds(60)), "1 min");
  EXPECT_EQ(about(seconds(200)), "3 min");
  EXPECT_EQ(about(seconds(3600)), "1 h 0 min");
  EXPECT_EQ(about(seconds(5000)), "1 h 20 min");
}

}  // namespace

}  // namespace itin::cli
