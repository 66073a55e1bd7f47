#include <gmock/gmock.h>
#include <limits>

#include <gtest/gtest.h>

#include <itin/detail.hpp>
#include <itin/error.hpp>

namespace itin {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string complaint(const std::vector<Ring>& rings) {
  try {
    Detail::rings({0, 0}, rings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(Detail, KeepsItsRings) {
  const Detail detail = Detail::rings({1, 2}, {{500, 0}, {2000, 1}, {10000, 1}});
  EXPECT_EQ(detail.centre(), (Point2{1, 2}));
  EXPECT_EQ(detail.rings().size(), 3u);
  EXPECT_EQ(detail.finest(), 0);
  EXPECT_EQ(detail.coarsest(), 1);
}

TEST(Detail, PlainToleranceIsOneEndlessRing) {
  const Detail detail = Detail::tolerance(2);
  ASSERT_EQ(detail.rings().size(), 1u);
  EXPECT_EQ(detail.rings().front().radius, kInfinity);
  EXPECT_EQ(detail.finest(), 2);
  EXPECT_EQ(detail.coarsest(), 2);
}

TEST(Detail, RefusesWhatIsNotATolerance) {
  EXPECT_THROW(Detail::tolerance(-0.5), InputError);
  EXPECT_THROW(Detail::tolerance(kNan), InputError);
  EXPECT_THROW(Detail::tolerance(kInfinity), InputError);
}

TEST(Detail, RefusesRingsOutOfOrder) {
  using ::testing::HasSubstr;
  EXPECT_THAT(complaint({}), HasSubstr("there is none"));
  EXPECT_THAT(complaint({{0, 1}}), HasSubstr("radius of ring 1"));
  EXPECT_THAT(complaint({{kNan, 1}}), HasSubstr("radius of ring 1"));
  EXPECT_THAT(complaint({{10, kNan}}), HasSubstr("tolerance of ring 1"));
  EXPECT_THAT(complaint({{10, 0}, {10, 1}}), HasSubstr("radius of ring 2"));
  EXPECT_THAT(complaint({{10, 2}, {20, 1}}), HasSubstr("tolerance of ring 2"));
  EXPECT_THROW(Detail::rings({kNan, 0}, {{10, 2}}), InputError);
}

}  // namespace
}  // namespace itin
