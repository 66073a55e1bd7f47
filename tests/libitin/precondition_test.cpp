// What a wrong call inside of the libraries does, and what one from outside does.
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/raster.hpp>
#include <itin/round_length.hpp>

#include "support/temporary_directory.hpp"

namespace itin {

namespace {

TEST(PreconditionDeathTest, EndsTheProgramNamingTheConditionAndItsPlace) {
#ifdef ITIN_CHECK_PRECONDITIONS
  EXPECT_DEATH(round_length(0), "round_length.hpp:[0-9]+: precondition does not hold: v > 0");
#else
  GTEST_SKIP() << "preconditions are not checked in this build";
#endif
}

TEST(Precondition, OfAnInstalledHeaderIsAnInputError) {
  const test::TemporaryDirectory directory;
  const RasterGrid grid({0, 20}, 10, 10, 2, 2);
  const std::vector<float> three(3);
  EXPECT_THROW(write_raster(directory.file("a.tif"), grid, std::span<const float>(three), {}), InputError);
  EXPECT_TRUE(directory.names().empty());
}

}  // namespace

}  // namespace itin
