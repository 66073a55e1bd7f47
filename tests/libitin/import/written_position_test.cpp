#include <gtest/gtest.h>

#include <itin/written_position.hpp>

namespace itin {
namespace {

void expect_grid(const char* text, Point2 expected) {
  const auto place = written_position(text);
  ASSERT_TRUE(place) << text;
  EXPECT_EQ(place->crs, "EPSG:27700");
  EXPECT_EQ(place->position, expected) << text;
}

TEST(WrittenPosition, ReadsTheNationalGrid) {
  expect_grid("ST 10375 83525", {310375, 183525});
  expect_grid("st1037583525", {310375, 183525});
  expect_grid("ST 103 835", {310300, 183500});
  expect_grid("TQ 30 80", {530000, 180000});
  expect_grid("SV 0 0", {0, 0});
  expect_grid("HU 396 753", {439600, 1175300});  // Shetland
  expect_grid("NN 166 712", {216600, 771200});   // Ben Nevis
  for (const char* none : {"ST", "ST1", "ST 123 45", "SI 12 34", "AA 12 34", "ZZ 1 1", "ST12x4", "12 34"})
    EXPECT_FALSE(written_position(none)) << none;
}

TEST(WrittenPosition, ReadsDegreesWithTheirLetters) {
  for (const char* text : {"51.5437N 3.2934W", "51.5437 N, 3.2934 W", "3.2934W,51.5437N",
                           "51\xC2\xB0"
                           "32'37.32\"N 3\xC2\xB0"
                           "17'36.24\"W",
                           "51 32 37.32 N 3 17 36.24 W", "51:32:37.32N,3:17:36.24W", "51 32.622 N 3 17.604 W"}) {
    const auto place = written_position(text);
    ASSERT_TRUE(place) << text;
    EXPECT_EQ(place->crs, "EPSG:4326");
    EXPECT_NEAR(place->position.x, -3.2934, 1e-9) << text;
    EXPECT_NEAR(place->position.y, 51.5437, 1e-9) << text;
  }
  for (const char* none : {"51.5437 3.2934", "51.5437N", "51.5437N 3.2934N", "51 60 0 N 3 0 0 W", "51.5 30 N 3 W",
                           "91N 3W", "51N 181E", "-51N 3W", "51N 3W 5", "N W", "1 2 3 4 N 3 W"})
    EXPECT_FALSE(written_position(none)) << none;
}

TEST(WrittenPosition, ReadsWhatWebMapsCopy) {
  for (const char* text : {"54.523388, -3.145489", " 54.523388,  -3.145489 "}) {
    const auto place = written_position(text);
    ASSERT_TRUE(place) << text;
    EXPECT_EQ(place->crs, "EPSG:4326");
    EXPECT_EQ(place->position, (Point2{-3.145489, 54.523388})) << text;
  }
  for (const char* none : {"54.523388,-3.145489", "310375, 183525", "91, 3", "51, 181", "51, 3, 2", "51, x", ", 3"})
    EXPECT_FALSE(written_position(none)) << none;
  for (const char* text : {"310375,183525", "310375, 183525", "310375 , 183525"})
    EXPECT_EQ(written_coordinates(text), (Point2{310375, 183525})) << text;
  for (const char* none : {"310375", "310375 183525", "1,2,3", "1,", ",2", "nan,1", "1,inf"})
    EXPECT_FALSE(written_coordinates(none)) << none;
}

TEST(WrittenPosition, TakesDecimalCommas) {
  for (const char* text : {"51,5437N 3,2934W", "51,5437 N, 3,2934 W",
                           "51\xC2\xB0"
                           "32,622'N, 3\xC2\xB0"
                           "17,604'W",
                           "51 32 37,32 N 3 17 36,24 W", "51:32:37,32N,3:17:36,24W"}) {
    const auto place = written_position(text);
    ASSERT_TRUE(place) << text;
    EXPECT_NEAR(place->position.x, -3.2934, 1e-9) << text;
    EXPECT_NEAR(place->position.y, 51.5437, 1e-9) << text;
  }
  EXPECT_EQ(written_angle("51,5", 'N', 'S'), 51.5);
  EXPECT_EQ(written_angle("-3,125", 'E', 'W'), -3.125);
  for (const char* none : {"51,32,37", "51,5 30", "51,32.5", "51.32,5"})
    EXPECT_FALSE(written_angle(none, 'N', 'S')) << none;
}

TEST(WrittenPosition, ReadsTheMilitaryGrid) {
  // The corners that national mapping agencies and GeographicLib publish for these.
  const auto expect = [](const char* text, const char* crs, Point2 expected) {
    const auto place = written_position(text);
    ASSERT_TRUE(place) << text;
    EXPECT_EQ(place->crs, crs) << text;
    EXPECT_EQ(place->position, expected) << text;
  };
  expect("31U DQ 48251 11932", "EPSG:32631", {448251, 5411932});  // the Eiffel Tower
  expect("18sUJ2348306479", "EPSG:32618", {323483, 4306479});     // the White House
  expect("56H LH 3436 5104", "EPSG:32756", {334360, 6251040});    // Sydney's Opera House
  expect("4QFJ12", "EPSG:32604", {610000, 2320000});              // Honolulu
  for (const char* none : {"61UDQ4825111932", "31IDQ48251119", "31UIQ4825", "31UDQ482", "31UDQ"})
    EXPECT_FALSE(written_position(none)) << none;
}

TEST(WrittenPosition, ReadsMaidenheadLocators) {
  const auto place = written_position("JN58td");  // Munich
  ASSERT_TRUE(place);
  EXPECT_EQ(place->crs, "EPSG:4326");
  EXPECT_NEAR(place->position.x, 11.625, 1e-9);
  EXPECT_NEAR(place->position.y, 48.14583333, 1e-7);
  EXPECT_NEAR(written_position("IO81hn36")->position.x, -3.3875, 1e-9);
  for (const char* none : {"IO81", "IS81jm", "IO8ajm", "IO81zz", "IO81jm3"})
    EXPECT_FALSE(written_position(none)) << none;
}

TEST(WrittenPosition, TakesAnglesWithASignAsWell) {
  EXPECT_EQ(written_angle("-3.5", 'E', 'W'), -3.5);
  EXPECT_EQ(written_angle(" 3 30 W ", 'E', 'W'), -3.5);
  EXPECT_FALSE(written_angle("3 N", 'E', 'W'));
  EXPECT_FALSE(written_angle("", 'E', 'W'));
}

}  // namespace
}  // namespace itin
