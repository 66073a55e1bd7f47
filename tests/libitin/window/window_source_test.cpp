#include <cmath>
#include <fstream>
#include <gmock/gmock.h>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/window_source.hpp>

#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using ::testing::HasSubstr;

std::string complaint(const std::string& polygon) {
  try {
    window_from_polygon(polygon);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(WindowSource, TextWithHolesAndParts) {
  const Window window = window_from_polygon(
      " MultiPolygon (((0 0, 10 0, 10 10, 0 10, 0 0), (2 2, 2 4, 4 4, 2 2)), ((20 20, 30 20, 20 30, 20 20)))");
  ASSERT_EQ(window.parts().size(), 2u);
  EXPECT_EQ(window.parts()[0].outer.size(), 4u);
  EXPECT_EQ(window.parts()[0].holes.size(), 1u);
  EXPECT_EQ(window.bounds(), (Box{0, 0, 30, 30}));
}

TEST(WindowSource, HeightsCurvesAndCollections) {
  EXPECT_EQ(window_from_polygon("POLYGON Z ((0 0 5, 10 0 6, 0 10 7, 0 0 5))").bounds(), (Box{0, 0, 10, 10}));
  const Box disc = window_from_polygon("CURVEPOLYGON (CIRCULARSTRING (0 0, 10 0, 0 0))").bounds();
  EXPECT_NEAR(disc.ymax, 5, 1e-3);
  EXPECT_EQ(window_from_polygon("GEOMETRYCOLLECTION (POINT (99 99), POLYGON ((0 0, 1 0, 0 1, 0 0)))").bounds(),
            (Box{0, 0, 1, 1}));
}

TEST(WindowSource, TextIsTransformedOnlyWhenItsCrsIsGiven) {
  const std::string text = "POLYGON ((-3 51, -3 52, -2.9 51, -3 51))";
  EXPECT_EQ(window_from_polygon(text, "EPSG:32630").bounds(), (Box{-3, 51, -2.9, 52}));
  const Box box = window_from_polygon(text, "EPSG:32630", "EPSG:4326").bounds();
  EXPECT_NEAR(box.xmin, 500000, 1e-3);  // the zone's central meridian
  EXPECT_NEAR(box.ymin, 5649824, 1000);
}

TEST(WindowSource, RefusesBadText) {
  EXPECT_THAT(complaint("POLYGON ((0 0, 10 0, x"), HasSubstr("not well-known text"));
  EXPECT_THAT(complaint("POLYGON ((0 0, 10 0, 0 10, 0 0)) nonsense"), HasSubstr("not well-known text"));
  EXPECT_THAT(complaint("POLYGON EMPTY"), HasSubstr("holds no polygon"));
  EXPECT_THAT(complaint("LINESTRING (0 0, 1 1)"), HasSubstr("holds no polygon"));
  EXPECT_THAT(complaint("POLYGON ((0 0, 1 1, 1 0, 0 1, 0 0))"), HasSubstr("crosses"));
  EXPECT_THROW(window_from_polygon("POLYGON ((0 0, 1 1, 1 0, 0 0))", "EPSG:32630", "nonsense"), InputError);
}

TEST(WindowSource, Files) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.file("a.geojson");
  std::ofstream(path) << R"({"type":"FeatureCollection","features":[
      {"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[-3,51],[-2.9,51],[-3,51.1],[-3,51]]]}},
      {"type":"Feature","properties":{},"geometry":null},
      {"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[0,0]}},
      {"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[-3,52],[-2.9,52],[-3,52.1],[-3,52]]]}}]})";
  EXPECT_EQ(window_from_polygon(path).parts().size(), 2u);
  EXPECT_NEAR(window_from_polygon(path).bounds().ymin, 51, 1e-12);
  EXPECT_NEAR(window_from_polygon(path, "EPSG:32630").bounds().xmin, 500000, 1e-3);
  EXPECT_THROW(window_from_polygon(path, "nonsense"), InputError);
}

TEST(WindowSource, FilesThatAreNone) {
  const test::TemporaryDirectory directory;
  EXPECT_THROW(window_from_polygon(directory.file("missing.gpkg")), FileError);
  std::ofstream(directory.file("junk.gpkg")) << "junk";
  EXPECT_THROW(window_from_polygon(directory.file("junk.gpkg")), FileError);
  std::ofstream(directory.file("point.geojson")) << R"({"type":"Point","coordinates":[0,0]})";
  EXPECT_THROW(window_from_polygon(directory.file("point.geojson")), InputError);
}

}  // namespace
}  // namespace itin
