// Colours of classes without an order, pair by pair.
#include <cmath>

#include <gtest/gtest.h>

#include "turbines/value_bands.hpp"

namespace itin::viewshed {
namespace {

double distance(const Rgba& a, const Rgba& b) {
  return std::hypot(a.red - b.red, a.green - b.green, a.blue - b.blue);
}

/// Maps of farms show twelve combinations at most.
TEST(DistinctColour, IsNotTakenForAnother) {
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(distance(distinct_colour(i), distinct_colour(j)), 50) << i << " and " << j;
}

/// However many there are, none looks like the first ones, which have the largest areas.
TEST(DistinctColour, LeavesTheFirstApart) {
  for (std::size_t i = 8; i < 200; ++i)
    for (std::size_t j = 0; j < 8; ++j)
      EXPECT_GE(distance(distinct_colour(i), distinct_colour(j)), 70) << i << " and " << j;
}

}  // namespace
}  // namespace itin::viewshed
