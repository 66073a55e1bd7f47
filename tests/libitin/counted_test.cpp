#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <itin/counted.hpp>

#include "support/seed.hpp"

namespace itin {
namespace {

TEST(Significant, WritesNumbersAsPeopleDo) {
  EXPECT_EQ(significant(0, 3), "0");
  EXPECT_EQ(significant(0.01234, 2), "0.012");
  EXPECT_EQ(significant(0.0000123, 2), "0.000012");
  EXPECT_EQ(significant(1.5, 4), "1.5");
  EXPECT_EQ(significant(99.996, 4), "100");
  EXPECT_EQ(significant(-250.04, 4), "-250");
  EXPECT_EQ(significant(100, 2), "100");
  EXPECT_EQ(significant(2628.2, 3), "2628");
  EXPECT_EQ(significant(12345.6, 2), "12346");
}

/// What is read back is within half a unit of the last digit, and no text has an exponent.
TEST(Significant, IsNearTheNumber) {
  std::mt19937 random(test::seed());
  std::uniform_real_distribution<double> exponent(-7, 9);
  for (int i = 0; i < 2000; ++i) {
    const double number = std::pow(10, exponent(random));
    for (const int digits : {1, 2, 3, 4}) {
      const std::string text = significant(number, digits);
      EXPECT_EQ(text.find_first_not_of("0123456789."), std::string::npos) << text;
      const double step = std::min(1.0, std::pow(10, std::floor(std::log10(number)) - digits + 1));
      EXPECT_NEAR(std::stod(text), number, step * 0.5000001) << text;
    }
  }
}

TEST(Listed, JoinsWordsAsASentenceDoes) {
  EXPECT_EQ(listed({}), "");
  EXPECT_EQ(listed({"walls"}), "walls");
  EXPECT_EQ(listed({"walls", "woods"}), "walls and woods");
  EXPECT_EQ(listed({"buildings", "walls", "woods"}), "buildings, walls and woods");
}

}  // namespace
}  // namespace itin
