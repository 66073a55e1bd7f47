#include <gtest/gtest.h>

#include <itin/grid_reference.hpp>

namespace itin {

namespace {

TEST(GridReference, KnownPlaces) {
  EXPECT_EQ(national_grid_reference({216666.9, 771288.2}), "NN 16666 71288");  // Ben Nevis
  EXPECT_EQ(national_grid_reference({260984, 354375}, 3), "SH 609 543");       // Snowdon
  EXPECT_EQ(national_grid_reference({310375, 183525}, 4), "ST 1037 8352");
  EXPECT_EQ(national_grid_reference({530000, 180000}, 2), "TQ 30 80");  // London
  EXPECT_EQ(national_grid_reference({446700, 1141600}, 1), "HU 4 4");   // Lerwick
  EXPECT_EQ(national_grid_reference({0, 0}), "SV 00000 00000");
}

TEST(GridReference, NothingBeyondTheSquares) {
  EXPECT_EQ(national_grid_reference({-1, 100000}), std::nullopt);
  EXPECT_EQ(national_grid_reference({700000, 100000}), std::nullopt);
  EXPECT_EQ(national_grid_reference({300000, 1300000}), std::nullopt);
}

TEST(UtmReference, IsOfTheZoneOfTheLongitude) {
  EXPECT_EQ(utm_zone_at({-180, 0}), 1);
  EXPECT_EQ(utm_zone_at({-3.001, 51}), 30);
  EXPECT_EQ(utm_zone_at({-0.001, 51}), 30);
  EXPECT_EQ(utm_zone_at({0, 51}), 31);
  EXPECT_EQ(utm_zone_at({180, 0}), 60);
  EXPECT_EQ(utm_zone_at({0, 84.1}), std::nullopt);
  EXPECT_EQ(utm_zone_at({0, -80.1}), std::nullopt);
  // On the middle meridian of zone 31, whose arc from the equator to 45 degrees, 4,984,944.38 m on WGS 84, has the
  // scale 0.9996.
  EXPECT_EQ(utm_reference({3, 45}), "UTM 31N 500000 4982950");
  EXPECT_EQ(utm_reference({3, -45}), "UTM 31S 500000 5017050");
  EXPECT_EQ(utm_reference({3, 85}), std::nullopt);
}

}  // namespace

}  // namespace itin
