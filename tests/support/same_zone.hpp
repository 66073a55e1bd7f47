// Expects two zones of visibility to be the same to the last bit.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <viewshed/turbines.hpp>

namespace itin::test {

inline void expect_same(const std::vector<float>& a, const std::vector<float>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint32_t>(a[i]), std::bit_cast<std::uint32_t>(b[i])) << "cell " << i;
}

inline void expect_same(const viewshed::Visibility& a, const viewshed::Visibility& b) {
  using viewshed::Visibility;
  EXPECT_EQ(a.hub_count, b.hub_count);
  EXPECT_EQ(a.tip_count, b.tip_count);
  EXPECT_EQ(a.hub_undecided, b.hub_undecided);
  EXPECT_EQ(a.tip_undecided, b.tip_undecided);
  EXPECT_EQ(a.turbines, b.turbines);
  EXPECT_EQ(a.height_sums_m, b.height_sums_m);
  for (const auto field :
       {&Visibility::visible_height_m, &Visibility::vertical_angle_deg, &Visibility::vertical_angle_sum_deg,
        &Visibility::horizontal_angle_deg, &Visibility::horizontal_from_deg, &Visibility::horizontal_occupied_deg,
        &Visibility::share, &Visibility::nearest_m})
    expect_same(a.*field, b.*field);
}

}  // namespace itin::test
