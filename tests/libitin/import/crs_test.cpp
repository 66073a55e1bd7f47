#include "gdal/crs.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <cpl_conv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <itin/celestial_body.hpp>
#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/parallel.hpp>

#include "support/seed.hpp"

namespace itin {
namespace {

using ::testing::HasSubstr;

TEST(Crs, TellsMetricOnesFromOthers) {
  EXPECT_TRUE(parse_crs("EPSG:27700", "a").metric());
  EXPECT_TRUE(parse_crs("EPSG:3857", "a").metric());
  EXPECT_FALSE(parse_crs("EPSG:4326", "a").metric());
  EXPECT_FALSE(parse_crs("EPSG:2253", "a").metric());
  EXPECT_FALSE(parse_crs("EPSG:4326", "a").metres_per_axis);
  EXPECT_DOUBLE_EQ(parse_crs("EPSG:2253", "a").metres_per_axis.value(), 0.3048);
}

TEST(Crs, KeepsOnlyTheHorizontalPart) {
  const Crs crs = parse_crs("EPSG:32617+6360", "a");
  EXPECT_EQ(crs.name, "EPSG:32617");
  EXPECT_TRUE(PointTransform(crs.wkt, "EPSG:32617", "a").identity());
  EXPECT_NEAR(crs.heights.value().metres, 1200.0 / 3937, 1e-12);
  EXPECT_FALSE(parse_crs("EPSG:27700", "a").heights);
  EXPECT_EQ(parse_crs("EPSG:4979", "a").metres_per_axis, std::nullopt);  // 3D
}

TEST(Crs, TellsWhatItsHeightsMean) {
  const auto heights = [](const std::string& crs) { return parse_crs(crs, "a").heights.value(); };
  EXPECT_EQ(heights("EPSG:27700+5701"), (HeightAxis{"Ordnance Datum Newlyn", "metre", 1, false}));
  EXPECT_EQ(heights("EPSG:32630+5715"), (HeightAxis{"Mean Sea Level", "metre", 1, true}));
  EXPECT_EQ(heights("EPSG:4979"), (HeightAxis{"the ellipsoid", "metre", 1, false}));
  const HeightAxis depth = heights("EPSG:26917+6358");  // NAVD88 depth (ftUS)
  EXPECT_EQ(depth.datum, "North American Vertical Datum 1988");
  EXPECT_EQ(depth.unit, "US survey foot");
  EXPECT_NEAR(depth.factor(), -1200.0 / 3937, 1e-12);
  const HeightAxis fathoms = heights(
      "COMPOUNDCRS[\"soundings\"," + parse_crs("EPSG:32630", "a").wkt +
      R"wkt(,VERTCRS["chart",VDATUM["Chart datum"],CS[vertical,1],AXIS["depth (D)",down],LENGTHUNIT["fathom",1.8288]]])wkt");
  EXPECT_EQ(fathoms, (HeightAxis{"Chart datum", "fathom", 1.8288, true}));
}

TEST(Crs, WithACodeThatNobodyKnowsIsWhatItsTextSays) {
  const std::string text =
      R"wkt(PROJCS["site grid",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",3.3],PARAMETER["scale_factor",1],PARAMETER["false_easting",500],PARAMETER["false_northing",0],UNIT["metre",1])wkt";
  const Crs plain = parse_crs(text + "]", "a");
  for (const std::string code : {R"("EPSG","0")", R"("EPSG","32767")", R"("LOCAL","1")", R"("Esri","999999")"}) {
    const Crs crs = parse_crs(text + ",AUTHORITY[" + code + "]]", "a");
    EXPECT_EQ(crs.name, "site grid") << code;
    EXPECT_TRUE(PointTransform(crs.wkt, plain.wkt, "a").identity()) << code;
    EXPECT_EQ(crs_identifier(crs.wkt), crs.wkt) << code;
    EXPECT_TRUE(PointTransform(parse_crs(crs.whole, "a").wkt, plain.wkt, "a").identity()) << code;
    const Crs compound = parse_crs(
        "COMPD_CS[\"x\"," + text + ",AUTHORITY[" + code +
            R"wkt(]],VERT_CS["EGM96 height",VERT_DATUM["EGM96 geoid",2005],UNIT["metre",1],AUTHORITY["EPSG","99999"]]])wkt",
        "a");
    EXPECT_TRUE(PointTransform(compound.wkt, plain.wkt, "a").identity()) << code;
    EXPECT_EQ(parse_crs(compound.whole, "a").heights, compound.heights) << code;
  }
}

TEST(Crs, TellsTheBodyItIsOf) {
  EXPECT_TRUE(body_of(parse_crs("EPSG:27700", "a").wkt).is_earth);
  EXPECT_TRUE(body_of(parse_crs("+proj=laea +R=6370997 +units=m", "a").wkt).is_earth);
  const Crs moon = parse_crs("+proj=tmerc +R=1737400 +units=m", "a");
  const CelestialBody body = body_of(moon.wkt);
  EXPECT_FALSE(body.is_earth);
  EXPECT_EQ(body.mean_radius_m(), 1737400);
  EXPECT_NEAR(CoordinateTransform(moon.wkt, body.geographic_crs)({0, 1737400 * std::numbers::pi / 180}).y, 1, 1e-9);
  EXPECT_NEAR(body_of(parse_crs("+proj=tmerc +a=3396190 +b=3376200 +units=m", "a").wkt).mean_radius_m(), 3389526.7,
              0.1);
  EXPECT_THROW(utm_zone(moon, {0, 0}, "a"), InputError);
}

/// Every dialect that recognises a CRS must recognise what it made of it, and no other.
TEST(Crs, IsTheSameInEveryDialect) {
  const std::vector<std::string> texts{
      "EPSG:27700",
      "EPSG:28992",
      "EPSG:2154",
      "EPSG:5514",
      "EPSG:2180",
      "EPSG:4326",
      "EPSG:3857",
      "+proj=utm +zone=30 +datum=WGS84 +units=m",
      "+proj=utm +zone=55 +south +ellps=GRS80 +units=m",
      "+proj=tmerc +lat_0=49 +lon_0=-2 +k=0.9996012717 +x_0=400000 +y_0=-100000 +ellps=airy +units=m",
      "+proj=laea +lat_0=-89 +lon_0=0 +datum=WGS84 +units=m",
      "+proj=lcc +lat_1=49 +lat_2=44 +lat_0=46.5 +lon_0=3 +x_0=700000 +y_0=6600000 +ellps=GRS80 +units=m"};
  constexpr const char* kDialects[] = {"WKT1_GDAL", "WKT1_ESRI", "WKT2_2015", "WKT2_2018"};
  for (const std::string& text : texts) {
    const OGRSpatialReference understood = horizontal_crs(text, "a");
    EXPECT_TRUE(same_crs(understood, horizontal_crs(parse_crs(text, "a").wkt, "a"))) << text;
    for (const char* dialect : kDialects) {
      OGRSpatialReference nameless = understood;
      nameless.SetFromUserInput(text.c_str());
      nameless.SetProjCS("unnamed");
      char* wkt = nullptr;
      const std::string format = std::string("FORMAT=") + dialect;
      const char* const options[] = {format.c_str(), nullptr};
      if (text != "EPSG:4326") nameless.exportToWkt(&wkt, options);
      const std::string dialect_text = wkt ? wkt : text;
      CPLFree(wkt);
      const Crs made = parse_crs(dialect_text, "a");
      EXPECT_TRUE(same_crs(horizontal_crs(dialect_text, "a"), horizontal_crs(made.wkt, "a"))) << dialect_text;
    }
    for (const std::string& other : texts)
      EXPECT_EQ(same_crs(understood, horizontal_crs(other, "a")), text == other) << text << "\n" << other;
  }
}

TEST(Crs, RecognisesDialectsWithoutCodes) {
  // As it comes with OS Terrain 50.
  const Crs crs = parse_crs(
      R"(PROJCS["British_National_Grid",GEOGCS["GCS_OSGB_1936",DATUM["D_OSGB_1936",SPHEROID["Airy_1830",6377563.396,)"
      R"(299.3249646]],PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],)"
      R"(PARAMETER["False_Easting",400000.0],PARAMETER["False_Northing",-100000.0],PARAMETER["Central_Meridian",-2.0],)"
      R"(PARAMETER["Scale_Factor",0.9996012717],PARAMETER["Latitude_Of_Origin",49.0],UNIT["Meter",1.0]])",
      "a");
  EXPECT_EQ(crs.name, "EPSG:27700");
  EXPECT_TRUE(PointTransform(crs.wkt, "EPSG:27700", "a").identity());
}

TEST(Crs, TakesNoUnknownDatumForAKnownOne) {
  const Crs crs = parse_crs("+proj=utm +zone=55 +south +ellps=GRS80 +units=m", "a");  // no authority knows it
  EXPECT_EQ(crs.name.find("EPSG"), std::string::npos) << crs.name;
  EXPECT_EQ(parse_crs("+proj=utm +zone=55 +south +datum=WGS84 +units=m", "a").name, "EPSG:32755");
  // A false easting of its own.
  EXPECT_EQ(parse_crs("+proj=tmerc +lon_0=147 +k=0.9996 +x_0=500001 +y_0=10000000 +datum=WGS84 +units=m", "a").name,
            "unknown");
}

TEST(Crs, RefusesWhatItDoesNotUnderstandInOneLine) {
  for (const auto& [text, reason] :
       {std::pair{"EPSG:1", "is not understood"}, std::pair{"", "is not understood"},
        std::pair{"nonsense", "is not understood"}, std::pair{"EPSG:5703", "only vertical"},
        std::pair{"EPSG:4978", "neither projected nor geographic"}}) {
    try {
      parse_crs(text, "--crs");
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(reason));
      EXPECT_THAT(error.what(), HasSubstr("--crs: "));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

TEST(UtmZone, IsTheOneOfThePositionAndDatum) {
  const auto zone = [](const char* crs, double x, double y) { return utm_zone(parse_crs(crs, "a"), {x, y}, "a").name; };
  EXPECT_EQ(zone("EPSG:4326", -3.2, 51.5), "EPSG:32630");
  EXPECT_EQ(zone("EPSG:4326", -180, 1), "EPSG:32601");
  EXPECT_EQ(zone("EPSG:4326", 179.99, 1), "EPSG:32660");
  EXPECT_EQ(zone("EPSG:4326", 190, 1), "EPSG:32602");
  EXPECT_EQ(zone("EPSG:4326", 147.3, -42.9), "EPSG:32755");
  EXPECT_EQ(zone("EPSG:4258", 9, 50), "EPSG:25832");
  EXPECT_EQ(zone("EPSG:4258", -40, 50), "EPSG:32624");  // ETRS89 has no such zone
  EXPECT_EQ(zone("EPSG:4269", -84.5, 42), "EPSG:26916");
  EXPECT_EQ(zone("EPSG:2253", 13293600, 282500), "EPSG:26917");  // NAD83, feet
  EXPECT_THROW(zone("EPSG:4326", 0, 89), InputError);
  EXPECT_THROW(zone("EPSG:4326", 0, -85), InputError);
}

TEST(PointTransform, AgreesWithSinglePointsWhateverTheThreads) {
  std::mt19937_64 random(test::seed());
  std::vector<double> x(5000), y(5000);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = -6 + 6e-6 * static_cast<double>(random() % 1000000);
    y[i] = 49 + 6e-6 * static_cast<double>(random() % 1000000);
  }
  OGRSpatialReference from, to;
  from.importFromEPSG(4326);
  to.importFromEPSG(32630);
  for (OGRSpatialReference* crs : {&from, &to}) crs->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> truth(OGRCreateCoordinateTransformation(&from, &to));
  for (const int threads : {1, 2, 0}) {
    set_thread_count(threads);
    std::vector<double> tx = x, ty = y;
    PointTransform("EPSG:4326", "EPSG:32630", "a").transform(tx, ty);
    for (std::size_t i = 0; i < x.size(); ++i) {
      double ex = x[i], ey = y[i];
      ASSERT_TRUE(truth->Transform(1, &ex, &ey));
      ASSERT_EQ(tx[i], ex);
      ASSERT_EQ(ty[i], ey);
    }
  }
  set_thread_count(0);
}

TEST(PointTransform, MarksWhatHasNoImage) {
  std::vector<double> x{0, 500, std::numeric_limits<double>::quiet_NaN(), 3}, y{0, 500, 0, 50};
  const PointTransform transform("EPSG:4326", "EPSG:32631", "a");
  transform.transform(x, y);
  EXPECT_FALSE(std::isnan(x[0]));
  EXPECT_TRUE(std::isnan(x[1]) && std::isnan(y[1]));
  EXPECT_TRUE(std::isnan(x[2]) && std::isnan(y[2]));
  EXPECT_NEAR(x[3], 500000, 1e-6);
}

TEST(PointTransform, IsTheIdentityBetweenEquals) {
  EXPECT_TRUE(PointTransform("EPSG:4326", "OGC:CRS84", "a").identity());
  EXPECT_TRUE(PointTransform(parse_crs("EPSG:27700", "a").wkt, "EPSG:27700", "a").identity());
  EXPECT_FALSE(PointTransform("EPSG:27700", "EPSG:32630", "a").identity());
}

}  // namespace
}  // namespace itin
