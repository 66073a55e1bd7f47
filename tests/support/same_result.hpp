// Whether two viewsheds are the same, cell for cell and to the last bit, in every mode.
#pragma once

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include <viewshed/viewshed.hpp>

#include "support/same_bits.hpp"

namespace itin::test {

/// No number is the same as no number.
inline bool same_values(const std::vector<float>& a, const std::vector<float>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](float x, float y) { return same_bits(x, y); });
}

/// But for the statistics, and for what they were asked to do it with.
inline void expect_same_result(const viewshed::Result& expected, const viewshed::Result& found) {
  EXPECT_TRUE(found.grid == expected.grid);
  EXPECT_EQ(found.certified, expected.certified);
  EXPECT_EQ(found.decided_exactly, expected.decided_exactly);
  EXPECT_TRUE(found.visible == expected.visible);
  EXPECT_TRUE(found.count == expected.count);
  EXPECT_TRUE(found.which == expected.which);
  EXPECT_TRUE(same_values(found.angle_deg, expected.angle_deg));
  EXPECT_TRUE(found.nearest == expected.nearest);
  EXPECT_TRUE(same_values(found.distance_m, expected.distance_m));
  EXPECT_TRUE(found.blockers == expected.blockers);
  EXPECT_TRUE(found.blocker == expected.blocker);
  EXPECT_TRUE(found.blocker_theme == expected.blocker_theme);
  EXPECT_TRUE(found.blocker_feature == expected.blocker_feature);
  EXPECT_TRUE(same_values(found.least_height_m, expected.least_height_m));
  EXPECT_TRUE(same_values(found.probability, expected.probability));
  EXPECT_TRUE(same_values(found.loss_db, expected.loss_db));
  EXPECT_TRUE(same_values(found.free_space_db, expected.free_space_db));
  EXPECT_EQ(found.cells.zone_cut, expected.cells.zone_cut);
  EXPECT_EQ(found.cells.visible, expected.cells.visible);
  EXPECT_EQ(found.cells.hidden, expected.cells.hidden);
  EXPECT_EQ(found.cells.undecided, expected.cells.undecided);
  EXPECT_EQ(found.cells.outside, expected.cells.outside);
  EXPECT_EQ(found.warnings, expected.warnings);
}

}  // namespace itin::test
