#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <itin/earth.hpp>
#include <itin/error.hpp>

namespace itin {
namespace {

TEST(Earth, DropsAtFortyKilometres) {
  const auto drop = [](double k) {
    Earth earth;
    earth.refraction = k;
    return earth.drop(40000);
  };
  EXPECT_NEAR(drop(0), 125.6, 0.05);
  EXPECT_NEAR(drop(1.0 / 7), 107.6, 0.05);
  EXPECT_NEAR(drop(0.13), 109.2, 0.05);
  EXPECT_NEAR(Earth{}.drop(40000), 109.2, 0.05);
  EXPECT_NEAR(Earth::effective_earth(4.0 / 3).drop(40000), 94.2, 0.05);
  EXPECT_EQ(Earth::flat().drop(40000), 0);
}

TEST(Earth, SaysItsConvention) {
  EXPECT_EQ(Earth{}.convention(), "drop = d^2 (1 - k) / (2 R), k = 0.13, R = 6371000 m");
  EXPECT_EQ(Earth::effective_earth(4.0 / 3).convention(), "drop = d^2 / (2 K R), K = 1.33333, R = 6371000 m");
  EXPECT_EQ(Earth::flat().convention(), "no curvature, no refraction");
}

TEST(Earth, RefusesWhatIsNoEarth) {
  const auto refuses = [](double radius, double refraction, double factor) {
    Earth earth;
    earth.radius = radius, earth.refraction = refraction, earth.effective_factor = factor;
    EXPECT_THROW(earth.validate(), InputError) << radius << " " << refraction << " " << factor;
  };
  refuses(0, 0.13, 1);
  refuses(-1, 0.13, 1);
  refuses(std::numeric_limits<double>::infinity(), 0.13, 1);
  refuses(6371000, 1, 1);
  refuses(6371000, std::nan(""), 1);
  refuses(6371000, 0.13, 0);
  EXPECT_NO_THROW(Earth{}.validate());
  EXPECT_NO_THROW(Earth::effective_earth(4.0 / 3).validate());
}

}  // namespace
}  // namespace itin
