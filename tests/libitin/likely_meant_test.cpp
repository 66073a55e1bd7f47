#include <gtest/gtest.h>

#include <itin/likely_meant.hpp>

namespace itin::test {

namespace {

const std::vector<std::string> kOptions = {"--observer", "--observers", "--radius",  "--min-radius",
                                           "--cell",     "--output",    "--horizon", "--json"};

TEST(LikelyMeant, FindsWhatIsMisspelt) {
  EXPECT_EQ(likely_meant("--observr", kOptions), "--observer");
  EXPECT_EQ(likely_meant("--raduis", kOptions), "--radius");
  EXPECT_EQ(likely_meant("--cel", kOptions), "--cell");
  EXPECT_EQ(likely_meant("-radius", kOptions), "--radius");
  EXPECT_EQ(likely_meant("--horizon", kOptions), "--horizon");
}

TEST(LikelyMeant, FindsWhatIsBegun) {
  EXPECT_EQ(likely_meant("--out", kOptions), "--output");
  EXPECT_EQ(likely_meant("--obs", kOptions), "--observer");
}

TEST(LikelyMeant, GuessesNothingFarOff) {
  EXPECT_EQ(likely_meant("--depth", kOptions), std::nullopt);
  EXPECT_EQ(likely_meant("-x", kOptions), std::nullopt);
  EXPECT_EQ(likely_meant("--", kOptions), std::nullopt);
  EXPECT_EQ(likely_meant("", kOptions), std::nullopt);
}

}  // namespace

}  // namespace itin::test
