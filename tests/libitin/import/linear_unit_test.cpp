#include "gdal/linear_unit.hpp"

#include <gtest/gtest.h>

namespace itin {
namespace {

TEST(LinearUnit, HasEpsgsCodes) {
  for (const auto& [code, metres] :
       {std::pair{9001, 1.0}, std::pair{9002, 0.3048}, std::pair{9003, 1200.0 / 3937}, std::pair{9014, 1.8288},
        std::pair{9036, 1000.0}, std::pair{1033, 0.01}, std::pair{9095, 0.3048007491}})
    EXPECT_EQ(linear_unit(code).value().metres, metres) << code;
  EXPECT_FALSE(linear_unit(0));
  EXPECT_FALSE(linear_unit(9102));  // the degree
}

TEST(LinearUnit, IsKnownByItsNamesInEveryDialect) {
  for (const char* name : {"m", "M", "metre", "Meters", "[m]", " metres ", "Meter"})
    EXPECT_EQ(linear_unit(name).value().metres, 1) << name;
  for (const char* name : {"US survey foot", "Foot_US", "us-ft", "US_survey_foot", "ftUS", "US Survey Feet"})
    EXPECT_EQ(linear_unit(name).value().metres, 1200.0 / 3937) << name;
  EXPECT_EQ(linear_unit("Fathoms").value().name, "fathom");
  EXPECT_EQ(linear_unit("cm").value().metres, 0.01);
  for (const char* name : {"", "[]", "cubit", "degree", "|", "m|meter", "foot|feet"}) EXPECT_FALSE(linear_unit(name));
}

TEST(LinearUnit, IsNamedAfterItsLength) {
  EXPECT_EQ(unit_name(0.304800609601219, "?"), "US survey foot");
  EXPECT_EQ(unit_name(0.3048, "?"), "foot");
  EXPECT_EQ(unit_name(0.31, "?"), "?");
}

}  // namespace
}  // namespace itin
