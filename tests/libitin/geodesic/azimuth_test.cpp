// Azimuths in words.
#include <string>

#include <gtest/gtest.h>

#include <itin/azimuth.hpp>

namespace itin {
namespace {

TEST(CompassPoints, AreTheNearestOfSixteen) {
  EXPECT_STREQ(compass_point(0), "north");
  EXPECT_STREQ(compass_point(11.2), "north");
  EXPECT_STREQ(compass_point(11.3), "north-north-east");
  EXPECT_STREQ(compass_point(90), "east");
  EXPECT_STREQ(compass_point(225), "south-west");
  EXPECT_STREQ(compass_point(348.7), "north-north-west");
  EXPECT_STREQ(compass_point(348.8), "north");
  EXPECT_STREQ(compass_point(-90), "west");
}

}  // namespace
}  // namespace itin
