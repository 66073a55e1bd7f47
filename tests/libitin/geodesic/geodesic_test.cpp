#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/geodesic.hpp>

namespace itin {

namespace {

TEST(Geodesic, HasPublishedValues) {
  // Flinders Peak to Buninyong, Geocentric Datum of Australia technical manual (GRS80, whose flattening differs from
  // WGS84's in the ninth digit): 54972.271 m, 306 52 05.37, reverse 127 10 25.07.
  const Point2 flinders{144 + 25 / 60.0 + 29.52440 / 3600, -(37 + 57 / 60.0 + 3.72030 / 3600)};
  const Point2 buninyong{143 + 55 / 60.0 + 35.38390 / 3600, -(37 + 39 / 60.0 + 10.15610 / 3600)};
  const Geodesic line = geodesic(flinders, buninyong);
  EXPECT_NEAR(line.distance_m, 54972.271, 0.001);
  EXPECT_NEAR(line.azimuth_deg, 306 + 52 / 60.0 + 5.37 / 3600, 0.01 / 3600);
  EXPECT_NEAR(line.back_azimuth_deg, 127 + 10 / 60.0 + 25.07 / 3600, 0.01 / 3600);
}

TEST(Geodesic, IsTheSameFromEitherEnd) {
  const Point2 a{-4.0763, 53.0685}, b{-3.4369, 51.8840};
  const Geodesic there = geodesic(a, b), back = geodesic(b, a);
  EXPECT_NEAR(there.distance_m, back.distance_m, 1e-6);
  EXPECT_NEAR(there.azimuth_deg, back.back_azimuth_deg, 1e-9);
  EXPECT_NEAR(there.back_azimuth_deg, back.azimuth_deg, 1e-9);
}

TEST(Geodesic, TakesMeridiansAndCoincidence) {
  EXPECT_NEAR(geodesic({5, 50}, {5, 51}).azimuth_deg, 0, 1e-12);
  EXPECT_NEAR(geodesic({5, 50}, {5, 51}).back_azimuth_deg, 180, 1e-12);
  EXPECT_EQ(geodesic({5, 50}, {5, 50}).distance_m, 0);
  EXPECT_NEAR(geodesic({0, 0}, {1, 0}).distance_m, 111319.491, 0.001);
  EXPECT_THROW(geodesic({0, 0}, {179.9, 0.1}), InputError);
}

}  // namespace

}  // namespace itin
