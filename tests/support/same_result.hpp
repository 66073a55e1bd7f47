// Whether two viewsheds are the same, cell for cell and to the last bit, in every mode.
#pragma once

#include <algorithm>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include <viewshed/result.hpp>

#include "support/same_bits.hpp"

namespace itin::test {

/// Counts NaN as the same as NaN.
inline bool same_values(const std::vector<float>& a, const std::vector<float>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](float x, float y) { return same_bits(x, y); });
}

/// Tells whether the values of two results are the same, and of one mode.
struct SameModeValues {
  bool operator()(std::monostate, std::monostate) const { return true; }
  bool operator()(const viewshed::Counts& a, const viewshed::Counts& b) const { return a.count == b.count; }
  bool operator()(const viewshed::ObserverSets& a, const viewshed::ObserverSets& b) const { return a.words == b.words; }
  bool operator()(const viewshed::Angles& a, const viewshed::Angles& b) const {
    return same_values(a.angle_deg, b.angle_deg);
  }
  bool operator()(const viewshed::NearestObservers& a, const viewshed::NearestObservers& b) const {
    return a.number == b.number && same_values(a.distance_m, b.distance_m);
  }
  bool operator()(const viewshed::Blockers& a, const viewshed::Blockers& b) const {
    return a.triangles == b.triangles && a.triangle == b.triangle && a.theme == b.theme && a.feature == b.feature;
  }
  bool operator()(const viewshed::LeastHeights& a, const viewshed::LeastHeights& b) const {
    return same_values(a.height_m, b.height_m);
  }
  bool operator()(const viewshed::Probabilities& a, const viewshed::Probabilities& b) const {
    return same_values(a.probability, b.probability);
  }
  bool operator()(const viewshed::Losses& a, const viewshed::Losses& b) const {
    return same_values(a.diffraction_db, b.diffraction_db) && same_values(a.free_space_db, b.free_space_db);
  }
  bool operator()(const viewshed::Levels& a, const viewshed::Levels& b) const {
    return same_values(a.level_dbm, b.level_dbm) && same_values(a.outage_minutes, b.outage_minutes) &&
           a.observer == b.observer;
  }
  template <class A, class B>
  bool operator()(const A&, const B&) const {
    return false;
  }
};

inline bool same_values(const viewshed::ModeValues& a, const viewshed::ModeValues& b) {
  return std::visit(SameModeValues{}, a, b);
}

/// Expects results to be the same, except for their statistics and for what they were asked to use.
inline void expect_same_result(const viewshed::Result& expected, const viewshed::Result& found) {
  EXPECT_TRUE(found.grid == expected.grid);
  EXPECT_EQ(found.certified, expected.certified);
  EXPECT_EQ(found.decided_exactly, expected.decided_exactly);
  EXPECT_TRUE(found.visible == expected.visible);
  EXPECT_TRUE(same_values(found.values, expected.values));
  EXPECT_EQ(found.cells.zone_cut, expected.cells.zone_cut);
  EXPECT_EQ(found.cells.visible, expected.cells.visible);
  EXPECT_EQ(found.cells.hidden, expected.cells.hidden);
  EXPECT_EQ(found.cells.undecided, expected.cells.undecided);
  EXPECT_EQ(found.cells.outside, expected.cells.outside);
  EXPECT_EQ(found.warnings, expected.warnings);
}

}  // namespace itin::test
