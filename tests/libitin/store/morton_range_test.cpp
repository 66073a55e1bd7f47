#include "geometry/morton_range.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "libitin/store/random_points.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

TEST(MortonRange, FindsEveryPositionOfABoxInOrder) {
  std::mt19937_64 random(test::seed());
  const auto uniform = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  for (int trial = 0; trial < 300; ++trial) {
    const int x = uniform(-20, 20), y = uniform(-20, 20);
    const GridBox box{x, y, x + uniform(0, 12), y + uniform(0, 12)};
    std::vector<std::uint64_t> expected;
    for (int px = box.xmin; px <= box.xmax; ++px) {
      for (int py = box.ymin; py <= box.ymax; ++py) expected.push_back(morton(px, py));
    }
    std::sort(expected.begin(), expected.end());
    std::vector<std::uint64_t> found;
    const MortonRange range(box);
    for (auto code = range.next(0); code; code = range.next(*code + 1)) found.push_back(*code);
    ASSERT_EQ(found, expected);
  }
}

TEST(MortonRange, EndsOfTheGrid) {
  const GridBox beyond{-2000000000, -2000000000, 2000000000, 2000000000};
  ASSERT_TRUE(MortonRange::exists(beyond));
  const MortonRange all(beyond);
  const std::uint64_t last = (std::uint64_t{1} << 60) - 1;
  EXPECT_EQ(all.next(0), 0u);
  EXPECT_EQ(all.next(last), last);
  EXPECT_EQ(all.next(last + 1), std::nullopt);
  EXPECT_FALSE(MortonRange::exists({kGridHalfSide, 0, kGridHalfSide + 5, 5}));
  EXPECT_FALSE(MortonRange::exists(GridBox{}));
}

}  // namespace
}  // namespace itin
