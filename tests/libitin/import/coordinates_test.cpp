#include <gmock/gmock.h>

#include <cpl_conv.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <ogr_srs_api.h>

#include <itin/coordinates.hpp>
#include <itin/crs_words.hpp>
#include <itin/error.hpp>

namespace itin {

namespace {

using ::testing::AnyOf;

// The Ordnance Survey's worked example (A guide to coordinate systems in Great Britain, section C.1): 52° 39' 27.2531"
// N 1° 43' 4.5177" E in OSGB36 (EPSG:4277) is 651409.903, 313177.270.
TEST(CoordinateTransform, FollowsTheWorkedExample) {
  const CoordinateTransform transform("EPSG:4277", "EPSG:27700");
  const Point2 p = transform({1 + 43 / 60.0 + 4.5177 / 3600, 52 + 39 / 60.0 + 27.2531 / 3600});
  EXPECT_NEAR(p.x, 651409.903, 0.001);
  EXPECT_NEAR(p.y, 313177.270, 0.001);
}

TEST(CoordinateTransform, TakesLongitudeFirstWhateverTheAuthoritySays) {
  // Latitude comes first in EPSG:4326, northing first in EPSG:2180 (Poland).
  const Point2 warsaw = CoordinateTransform("EPSG:4326", "EPSG:2180")({21.01, 52.23});
  EXPECT_NEAR(warsaw.x, 637000, 2000);
  EXPECT_NEAR(warsaw.y, 487000, 2000);
}

TEST(CoordinateTransform, RefusesUnknownSystemsAndPointsWithoutAPlace) {
  EXPECT_THROW(CoordinateTransform("EPSG:1", "EPSG:27700"), InputError);
  EXPECT_THROW(CoordinateTransform("", "EPSG:27700"), InputError);
  EXPECT_THROW(CoordinateTransform("EPSG:4326", "nonsense"), InputError);
  const CoordinateTransform transform("EPSG:4326", "EPSG:27700");
  EXPECT_THROW(transform({51000, 300000}), InputError);
}

TEST(CrsNames, PreferCodesToText) {
  const std::string local = R"(ENGCRS["Building site",EDATUM["Peg 1"],CS[Cartesian,2],AXIS["x",east],AXIS["y",north],)"
                            R"(LENGTHUNIT["metre",1]])";
  EXPECT_EQ(crs_identifier(local), local);
  EXPECT_EQ(crs_title(local), "Building site");
  EXPECT_EQ(crs_in_short(local), "Building site");
  EXPECT_EQ(crs_in_full(local), "Building site");
  const std::string utm = R"(PROJCS["WGS 84 / UTM zone 30N",GEOGCS["WGS 84",DATUM["WGS_1984",)"
                          R"(SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],)"
                          R"(UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],)"
                          R"(PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",-3],)"
                          R"(PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],)"
                          R"(PARAMETER["false_northing",0],UNIT["metre",1],AUTHORITY["EPSG","32630"]])";
  EXPECT_EQ(crs_identifier(utm), "EPSG:32630");
  EXPECT_EQ(crs_title(utm), "WGS 84 / UTM zone 30N");
  EXPECT_EQ(crs_in_short(utm), "EPSG:32630");
  EXPECT_EQ(crs_in_full(utm), "WGS 84 / UTM zone 30N (EPSG:32630)");
}

/// As GDAL reads them in both of its dialects; but GDAL leaves out that a CRS is deprecated.
TEST(CrsNames, AreThoseThatGdalReads) {
  int count = 0, compared = 0;
  OSRCRSInfo** const all = OSRGetCRSInfoListFromDatabase("EPSG", nullptr, &count);
  ASSERT_GT(count, 5000);
  for (int i = 0; i < count; i += 17) {
    OGRSpatialReference reference;
    if (all[i]->eType != OSR_CRS_TYPE_PROJECTED ||
        reference.SetFromUserInput(fmt::format("EPSG:{}", all[i]->pszCode).c_str()) != OGRERR_NONE)
      continue;
    for (const char* format : {"FORMAT=WKT2_2018", "FORMAT=WKT1_GDAL"}) {
      const char* const options[] = {format, nullptr};
      char* wkt = nullptr;
      if (reference.exportToWkt(&wkt, options) != OGRERR_NONE) continue;  // not every method is known to WKT 1
      const OGRSpatialReference read(wkt);
      EXPECT_THAT(crs_title(wkt), AnyOf(std::string(read.GetName()), fmt::format("{} (deprecated)", read.GetName())));
      EXPECT_EQ(crs_identifier(wkt),
                fmt::format("{}:{}", read.GetAuthorityName(nullptr), read.GetAuthorityCode(nullptr)));
      CPLFree(wkt);
      ++compared;
    }
  }
  EXPECT_GT(compared, 400);
  OSRDestroyCRSInfoList(all);
}

}  // namespace

}  // namespace itin
