#include "import/raised_warnings.hpp"

#include <gmock/gmock.h>

#include <gtest/gtest.h>

namespace itin {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Houses of source 1, of which one cannot stand, and a wood of source 2.
RaisedFeaturesReport town(std::uint64_t houses) {
  RaisedFeaturesReport raised;
  raised.themes = {{"houses", houses, {{1, "a: left out: has no area"}}}, {"woods", 1, {{2, "b: has a hole"}}}};
  return raised;
}

StoreMetadata store_with(std::uint64_t houses) {
  StoreMetadata before;
  before.themes = {{"houses", ThemeKind::Buildings, houses, 0, 0, 1}};
  return before;
}

TEST(RaisedWarnings, OfOlderSourcesAreNotRepeated) {
  const StoreMetadata before = store_with(4);
  EXPECT_THAT(raised_warnings(town(4), &before, {2}), ElementsAre("theme 'woods': b: has a hole"));
  EXPECT_THAT(raised_warnings(town(4), &before, {3}), IsEmpty());
  EXPECT_EQ(raised_warnings(town(4), nullptr, {1, 2}).size(), 2U);
}

TEST(RaisedWarnings, TellWhatNoLongerStands) {
  const StoreMetadata before = store_with(5);
  EXPECT_THAT(raised_warnings(town(4), &before, {3}),
              ElementsAre("theme 'houses': 1 of its features stood before, and do not on this ground",
                          "theme 'houses': a: left out: has no area"));
}

TEST(RaisedWarnings, AreTwentyATheme) {
  RaisedFeaturesReport raised;
  raised.themes = {{"houses", 0, std::vector<RaisedReport>(50, {0, "a: left out"})}};
  const auto warnings = raised_warnings(raised, nullptr, {0});
  ASSERT_EQ(warnings.size(), 21U);
  EXPECT_THAT(warnings.back(), HasSubstr("30 more like these"));
}

}  // namespace
}  // namespace itin
