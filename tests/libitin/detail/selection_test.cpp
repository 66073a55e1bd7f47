#include "triangulate/apex/selection.hpp"

#include <cstdlib>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "support/seed.hpp"

namespace itin {
namespace {

const std::vector<double> kTolerances{0, 0.5, 1, 2, 4, 8, 16, 32};
const Grid kGrid{{100, 200}, 0.5};

TEST(Selection, PlainToleranceAsksForTheCoarsestLevelWithinIt) {
  const auto level = [](double tolerance) {
    const Selection selection(Detail::tolerance(tolerance), kTolerances, kGrid);
    EXPECT_EQ(selection.finest(), selection.coarsest());
    EXPECT_EQ(selection.finest_in({-10, -10, 10, 10}), selection.finest());
    return selection.finest();
  };
  EXPECT_EQ(level(0), 0);
  EXPECT_EQ(level(0.49), 0);
  EXPECT_EQ(level(0.5), 1);
  EXPECT_EQ(level(3.99), 3);
  EXPECT_EQ(level(4), 4);
  EXPECT_EQ(level(1000), 7);
}

TEST(Selection, RingRimBelongsToTheRing) {
  // Centre (103, 204) m is grid (6, 8); 2.5 m are 5 grid steps: (9, 12) is on the rim.
  const Selection selection(Detail::rings({103, 204}, {{2.5, 0}, {50, 2}}), kTolerances, kGrid);
  EXPECT_EQ(selection.finest(), 0);
  EXPECT_EQ(selection.coarsest(), 3);
  EXPECT_TRUE(selection.selects(0, 9, 12));
  EXPECT_FALSE(selection.selects(0, 10, 12));
  EXPECT_TRUE(selection.selects(3, 10, 12));
  EXPECT_FALSE(selection.selects(2, 1000000, 12));  // the last ring has no end
  EXPECT_TRUE(selection.selects(3, 1000000, 12));
  EXPECT_EQ(selection.finest_in({10, 12, 20, 20}), 3);
  EXPECT_EQ(selection.finest_in({9, 12, 20, 20}), 0);
  EXPECT_EQ(selection.finest_in({-100, -100, 100, 100}), 0);
}

TEST(Selection, AgreesWithDistancesOneByOne) {
  std::mt19937 random(test::seed());
  const Selection selection(Detail::rings({100, 200}, {{5, 0}, {10, 1}, {20, 4}, {40, 8}}), kTolerances, kGrid);
  const auto asked = [](std::int64_t x, std::int64_t y) {
    const std::int64_t d2 = x * x + y * y;
    return d2 <= 100 ? 0 : d2 <= 400 ? 2 : d2 <= 1600 ? 4 : 5;
  };
  std::uniform_int_distribution<std::int32_t> any(-60, 60);
  for (int i = 0; i < 2000; ++i) {
    GridBox box;
    box.extend(any(random), any(random));
    box.extend(any(random), any(random));
    int finest = 100;
    for (std::int32_t y = box.ymin; y <= box.ymax; ++y)
      for (std::int32_t x = box.xmin; x <= box.xmax; ++x) finest = std::min(finest, asked(x, y));
    ASSERT_EQ(selection.finest_in(box), finest);
    for (int level = 0; level < 8; ++level)
      ASSERT_EQ(selection.selects(level, box.xmin, box.ymin), level >= asked(box.xmin, box.ymin));
  }
}

TEST(Selection, CentreFarFromTheGridIsNoTrouble) {
  const Selection far(Detail::rings({1e300, -1e300}, {{500, 0}, {2000, 2}}), kTolerances, kGrid);
  EXPECT_FALSE(far.selects(0, 0, 0));
  const Selection wide(Detail::rings({0, 0}, {{1e300, 0}, {std::numeric_limits<double>::infinity(), 2}}), kTolerances,
                       kGrid);
  EXPECT_TRUE(wide.selects(0, kGridHalfSide - 1, -kGridHalfSide));
}

}  // namespace
}  // namespace itin
