#include "program/field_names.hpp"

#include <gtest/gtest.h>

namespace itin::cli {

namespace {

TEST(FieldNames, BecomeOptions) {
  EXPECT_EQ(in_options("a.tif: give `to_crs`, or `crs` EPSG:27700"), "a.tif: give --to-crs, or --crs EPSG:27700");
  EXPECT_EQ(in_options("`tolerances`: leave `tolerances` out"), "--levels: leave --levels out");
  EXPECT_EQ(in_options("`repair = false`: does nothing"), "--no-repair: does nothing");
}

TEST(FieldNames, LeaveOtherWordsAsTheyAre) {
  EXPECT_EQ(in_options("layer 'where `is` it'"), "layer 'where `is` it'");
  EXPECT_EQ(in_options(""), "");
}

}  // namespace

}  // namespace itin::cli
