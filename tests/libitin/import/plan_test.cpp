// Decisions of an import before it reads a point: kinds, CRS, grid, and every refusal.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <random>
#include <tuple>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/geodesic.hpp>
#include <itin/grid_scale.hpp>

#include "gdal/crs.hpp"
#include "libitin/import/raster_fixture.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using test::MadeRaster;
using test::TemporaryDirectory;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Plan : public ::testing::Test {
 protected:
  std::string raster(const std::string& name, const std::string& crs, std::array<double, 6> transform) {
    MadeRaster made;
    made.crs = crs;
    made.transform = transform;
    made.columns = made.rows = 3;
    made.posts.assign(9, 5);
    test::write_raster(directory_.file(name), made);
    return directory_.file(name);
  }
  std::string british(const std::string& name = "gb.tif") {
    return raster(name, "EPSG:27700", {318000, 50, 0, 176000, 0, -50});
  }
  std::string alpine(const std::string& name = "alps.tif") {
    return raster(name, "EPSG:4326", {8.5, 0.001, 0, 46.5, 0, -0.001});
  }
  /// Beside british().
  std::string welsh(const std::string& name = "wales.tif") {
    return raster(name, "EPSG:4326", {-3.2, 0.001, 0, 51.5, 0, -0.001});
  }

  ImportPlan plan(std::vector<std::string> sources, const StoreMetadata* existing = nullptr) {
    options_.sources = std::move(sources);
    return plan_import(options_, existing);
  }

  template <class E>
  std::string refusal(std::vector<std::string> sources, const StoreMetadata* existing = nullptr) {
    try {
      plan(std::move(sources), existing);
    } catch (const E& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    ADD_FAILURE() << "no exception";
    return {};
  }

  TemporaryDirectory directory_;
  ImportOptions options_;
};

TEST_F(Plan, KeepsAMetricCrs) {
  const ImportPlan made = plan({british(), welsh()});
  EXPECT_EQ(made.crs_name, "EPSG:27700");
  EXPECT_FALSE(made.crs_chosen);
  EXPECT_TRUE(PointTransform(made.crs_wkt, "EPSG:27700", "a").identity());
  EXPECT_EQ(made.grid, (Grid{{0, 0}, 0.01}));
  EXPECT_EQ(made.sources.size(), 2U);
  EXPECT_EQ(made.sources[0]->info().source_crs, "EPSG:27700");
  EXPECT_EQ(made.sources[1]->info().source_crs, "EPSG:4326");
  EXPECT_THAT(made.warnings, IsEmpty());
}

TEST_F(Plan, ChoosesTheUtmZoneOfTheFirstSource) {
  const ImportPlan made = plan({welsh(), british()});
  EXPECT_EQ(made.crs_name, "EPSG:32630");
  EXPECT_TRUE(made.crs_chosen);
  EXPECT_THAT(made.warnings, IsEmpty());
}

TEST_F(Plan, ChoosesTheUtmZoneWhereLengthsWouldBeWrong) {
  for (const auto& [crs, x, y] :
       {std::tuple("EPSG:3857", -356000.0, 6700000.0), std::tuple("EPSG:4087", -356000.0, 5700000.0),
        std::tuple("EPSG:3395", -356000.0, 6700000.0), std::tuple("EPSG:32632", -350000.0, 5740000.0)}) {
    const ImportPlan made = plan({raster("m.tif", crs, {x, 50, 0, y, 0, -50})});
    EXPECT_EQ(made.crs_name, "EPSG:32630") << crs;
    EXPECT_TRUE(made.crs_chosen);
    ASSERT_EQ(made.warnings.size(), 1U) << crs;
    EXPECT_THAT(made.warnings.front(), HasSubstr("; the store's is EPSG:32630 instead"));
    EXPECT_THAT(made.warnings.front(), HasSubstr(crs));
  }
}

TEST_F(Plan, ChoosesTheUtmZoneWhereAxesRunWestOrSouth) {
  for (const auto& [crs, x, y, zone] :
       {std::tuple("EPSG:2048", 55000.0, 3753000.0, "EPSG:32734"),
        std::tuple("EPSG:22275", 55000.0, 2545000.0, "EPSG:32733"),
        std::tuple("EPSG:2065", 1040000.0, 740000.0, "EPSG:32633"),
        std::tuple("EPSG:5513", 1040000.0, 740000.0, "EPSG:32633"),
        std::tuple("+proj=tmerc +lon_0=15 +ellps=GRS80 +axis=wnu +units=m", 1000.0, 5540000.0, "EPSG:32633")}) {
    options_.crs = crs;
    const ImportPlan made = plan({raster("m.tif", crs, {x, 50, 0, y, 0, -50})});
    EXPECT_EQ(made.crs_name, zone) << crs;
    EXPECT_TRUE(made.crs_chosen);
    ASSERT_FALSE(made.warnings.empty()) << crs;
    EXPECT_THAT(made.warnings.front(),
                HasSubstr("do not run to the east and to the north; the store's is " + std::string(zone)));
    options_ = {};
    options_.to_crs = crs;
    EXPECT_THAT(refusal<InputError>({british()}),
                HasSubstr("is not projected with axes in metres, to the east and to the north"));
    options_ = {};
  }
}

TEST_F(Plan, KeepsGridsAboutThePoles) {
  for (const auto& [crs, x, y] :
       {std::tuple("EPSG:3031", 1480000.0, 1480000.0), std::tuple("EPSG:3413", -300000.0, -2170000.0),
        std::tuple("EPSG:32661", 2680000.0, 1320000.0), std::tuple("EPSG:32761", 2680000.0, 1320000.0)}) {
    options_.to_crs = crs;
    EXPECT_EQ(plan({raster("p.tif", crs, {x, 50, 0, y, 0, -50})}).crs_name, crs);
  }
}

TEST_F(Plan, CountsZonesFromGreenwich) {
  const std::string degrees = raster("d.tif", "EPSG:4807", {4.2, 0.0005, 0, 54, 0, -0.0005});
  EXPECT_EQ(plan({degrees}).crs_name, "EPSG:32632");
}

TEST_F(Plan, KeepsNationalGrids) {
  const std::tuple<const char*, double, double> grids[] = {
      {"EPSG:27700", 5000, 900000},     {"EPSG:27700", 650000, 310000},   {"EPSG:28992", 85000, 446000},
      {"EPSG:2154", 1220000, 6080000},  {"EPSG:2154", 650000, 7110000},   {"EPSG:25832", 300000, 5500000},
      {"EPSG:32630", 170000, 100000},   {"EPSG:26918", 322000, 4297000},  {"EPSG:3067", 83000, 6710000},
      {"EPSG:2193", 2080000, 5820000},  {"EPSG:3006", 900000, 7350000},   {"EPSG:5514", -740000, -1040000},
      {"EPSG:25833", 1100000, 7880000}, {"EPSG:25830", 1115000, 4440000}, {"EPSG:2056", 2600000, 1200000},
      {"EPSG:31370", 150000, 170000},   {"EPSG:26986", 236000, 900000}};
  for (const auto& [crs, x, y] : grids) {
    const ImportPlan made = plan({raster("n.tif", crs, {x, 50, 0, y, 0, -50})});
    EXPECT_EQ(made.crs_name, crs);
    EXPECT_THAT(made.warnings, IsEmpty());
  }
}

TEST_F(Plan, RefusesACrsWhoseLengthsAreWrongWhereItIsAskedFor) {
  options_.to_crs = "EPSG:3857";
  EXPECT_EQ(refusal<InputError>({british()}),
            british() +
                ": lengths in EPSG:3857, the store's CRS, are up to 60.6 % too long there, where 0.2 % are "
                "allowed; give `to_crs` one made for that place, such as 'EPSG:32630', or import it into a store "
                "of its own, in pieces where it is wide");
  options_.to_crs = "EPSG:32633";
  EXPECT_THAT(refusal<InputError>({british()}), HasSubstr("such as 'EPSG:32630'"));
  options_.to_crs.clear();
  EXPECT_THAT(refusal<InputError>({alpine(), british()}), HasSubstr("gb.tif: lengths in EPSG:32632"));
  const std::string wide = raster("wide.tif", "EPSG:4326", {5, 4, 0, 5, 0, -4});
  EXPECT_THAT(refusal<InputError>({wide}), HasSubstr("+proj=laea +lat_0=-1 +lon_0=11 +datum=WGS84 +units=m"));
  options_.to_crs = "+proj=laea +lat_0=-1 +lon_0=11 +datum=WGS84 +units=m";
  EXPECT_EQ(plan({wide}).sources.size(), 1U);
}

TEST_F(Plan, RefusesToAddWhereLengthsInTheStoreAreWrong) {
  StoreMetadata existing;
  existing.crs_wkt = parse_crs("EPSG:27700", "a").wkt;
  existing.grid = {{0, 0}, 0.01};
  EXPECT_EQ(plan({welsh()}, &existing).sources.size(), 1U);
  EXPECT_THAT(
      refusal<InputError>({alpine()}, &existing),
      HasSubstr("alps.tif: lengths in EPSG:27700, the store's CRS, are up to 0.76 % too long there, where 0.5 % "
                "are allowed; import it into a store of its own"));
}

TEST_F(Plan, HelpsAtThePoles) {
  const std::string pole = raster("pole.tif", "EPSG:3031", {-100, 50, 0, 100, 0, -50});
  EXPECT_THAT(refusal<InputError>({pole}), HasSubstr("give `to_crs`"));
  options_.to_crs = "+proj=laea +lat_0=-90 +lon_0=0 +datum=WGS84 +units=m";
  EXPECT_EQ(plan({pole}).sources.size(), 1U);
}

/// Whatever web Mercator's tile, distances in the store are those on the ground.
TEST_F(Plan, KeepsLengthsAllOverTheWorld) {
  std::mt19937 random(test::seed());
  for (int i = 0; i < 30; ++i) {
    const double lon = std::uniform_real_distribution(-179.5, 179.5)(random);
    const double lat = std::uniform_real_distribution(-79.0, 83.0)(random);
    const Point2 place = CoordinateTransform("EPSG:4326", "EPSG:3857")({lon, lat});
    const ImportPlan made = plan({raster("m.tif", "EPSG:3857", {place.x, 1000, 0, place.y, 0, -1000})});
    const CoordinateTransform to_store("EPSG:4326", made.crs_wkt);
    const Point2 there{lon + 0.03, lat + 0.02}, a = to_store({lon, lat}), b = to_store(there);
    EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y) / geodesic({lon, lat}, there).distance_m, 1,
                kGreatestScaleErrorOfWorld)
        << lon << ", " << lat << ": " << made.crs_name;
  }
}

/// Mercator's projection stays near the equator, for as long as lengths are true to 0.2 %.
TEST_F(Plan, TakesMercatorNearTheEquatorAlone) {
  const auto at = [&](double latitude) {
    const Point2 place = CoordinateTransform("EPSG:4326", "EPSG:3395")({33, latitude});
    return plan({raster("m.tif", "EPSG:3395", {place.x, 1000, 0, place.y, 0, -1000})}).crs_name;
  };
  EXPECT_EQ(at(3), "EPSG:3395");
  EXPECT_EQ(at(4.5), "EPSG:32636");
}

TEST_F(Plan, ObeysToCrs) {
  options_.to_crs = "EPSG:32630";
  const ImportPlan made = plan({british()});
  EXPECT_EQ(made.crs_name, "EPSG:32630");
  EXPECT_FALSE(made.crs_chosen);
}

TEST_F(Plan, LetsCrsOverrideWhatASourceSays) {
  options_.crs = "EPSG:32631";
  EXPECT_EQ(plan({british()}).crs_name, "EPSG:32631");
}

TEST_F(Plan, PutsTheGridsOriginAMultipleOfHalfItsSideAway) {
  EXPECT_EQ(plan({raster("n.tif", "EPSG:32632", {500000, 50, 0, 5200000, 0, -50})}).grid.origin,
            (Point2{0, 5368709.12}));
  EXPECT_EQ(plan({raster("s.tif", "EPSG:32632", {500000, 50, 0, 2600000, 0, -50})}).grid.origin, (Point2{0, 0}));
  options_.resolution = 0.001;
  EXPECT_EQ(plan({british()}).grid, (Grid{{536870.912, 0}, 0.001}));
}

TEST_F(Plan, FollowsAnExistingStore) {
  StoreMetadata existing;
  existing.crs_wkt = parse_crs("EPSG:32630", "a").wkt;
  existing.grid = {{1000, 2000}, 0.05};
  const ImportPlan made = plan({british()}, &existing);
  EXPECT_EQ(made.crs_name, "EPSG:32630");
  EXPECT_EQ(made.grid, existing.grid);
  EXPECT_FALSE(made.crs_chosen);

  options_.to_crs = "EPSG:32630";
  EXPECT_EQ(plan({british()}, &existing).crs_name, "EPSG:32630");
  options_.to_crs = "EPSG:27700";
  EXPECT_EQ(
      refusal<InputError>({british()}, &existing),
      "`to_crs` EPSG:27700: the store's CRS is EPSG:32630 already; leave the option out, or import into a new store");
}

TEST_F(Plan, RefusesToMixVerticalDatums) {
  const std::array<double, 6> place{85000, 5, 0, 446000, 0, -5};
  const std::string nap = raster("nap.tif", "EPSG:7415", place), plain = raster("plain.tif", "EPSG:28992", place);
  const std::string evrf = raster("evrf.tif", "EPSG:28992+5621", place);
  EXPECT_EQ(plan({nap, plain}).sources.front()->info().source_crs, "EPSG:28992+5709");
  EXPECT_THAT(refusal<InputError>({nap, plain, evrf}), HasSubstr("evrf.tif: heights refer to European Vertical"));

  StoreMetadata existing;
  existing.crs_wkt = parse_crs("EPSG:28992", "a").wkt;
  existing.grid = {{0, 0}, 0.01};
  SourceInfo before;
  before.path = "before.tif";
  before.source_crs = plan({evrf}).sources.front()->info().source_crs;
  existing.sources = {before};
  EXPECT_EQ(plan({plain}, &existing).sources.size(), 1U);
  EXPECT_THAT(refusal<InputError>({nap}, &existing), HasSubstr("before.tif"));
  options_.allow_mixed_vertical = true;
  EXPECT_EQ(plan({nap, evrf}, &existing).sources.size(), 2U);
}

TEST_F(Plan, TellsKindsByContent) {
  const std::string points = directory_.write("p.csv", "x,y,z\n318000,176000,5\n318010,176000,6\n318000,176020,7\n");
  std::filesystem::copy(british(), directory_.file("really-a-tif.csv"));
  options_.crs = "EPSG:27700";
  const ImportPlan made = plan({points, directory_.file("really-a-tif.csv")});
  ASSERT_EQ(made.sources.size(), 2U);
  EXPECT_EQ(test::read(*made.sources[0]).points.size(), 3U);
  EXPECT_EQ(test::read(*made.sources[1]).points.size(), 9U);
}

TEST_F(Plan, RefusesWhatItCannotOpen) {
  EXPECT_EQ(refusal<FileError>({directory_.file("no.tif")}), directory_.file("no.tif") + ": there is no such file");
  EXPECT_THAT(refusal<FileError>({directory_.file("no.zip")}), HasSubstr("there is no such file"));
  EXPECT_THAT(refusal<FileError>({directory_.write("empty.tif", "")}), HasSubstr("empty.tif: is empty"));
  EXPECT_THAT(refusal<FileError>({directory_.write("novel.doc", "Call me Ishmael.")}), HasSubstr("novel.doc: "));
  EXPECT_THAT(refusal<FileError>({directory_.write("broken.las", "LASF and no more")}), HasSubstr("broken.las: "));
  EXPECT_THAT(refusal<FileError>({directory_.write("bad.zip", "PK and no more")}),
              HasSubstr("bad.zip: holds no raster or vector file that can be read"));
  EXPECT_THAT(refusal<FileError>({directory_.path()}), HasSubstr(directory_.path() + ": is a directory"));
}

TEST_F(Plan, RefusesWrongCalls) {
  EXPECT_THAT(refusal<InputError>({}), HasSubstr("name at least one source"));
  options_.crs = "EPSG:1";
  EXPECT_THAT(refusal<InputError>({british()}), HasSubstr("`crs`: the CRS 'EPSG:1' is not understood"));
  options_.crs.clear();
  options_.to_crs = "EPSG:4326";
  EXPECT_THAT(refusal<InputError>({british()}), HasSubstr("`to_crs`: EPSG:4326 is not projected with axes in metres"));
  options_.to_crs.clear();
  for (const double resolution : {0.0, -1.0, 1e-6, 100.0, std::numeric_limits<double>::quiet_NaN()}) {
    options_.resolution = resolution;
    EXPECT_THAT(refusal<InputError>({british()}), HasSubstr("`resolution`"));
  }
}

TEST_F(Plan, RefusesPositionsBeyondTheGrid) {
  options_.resolution = 0.0001;  // reaches 54 km
  const ImportPlan made = plan({british(), raster("far.tif", "EPSG:27700", {500000, 50, 0, 176000, 0, -50})});
  EXPECT_EQ(test::read(*made.sources[0]).points.size(), 9U);
  try {
    test::read(*made.sources[1]);
    FAIL() << "no exception";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("far.tif: position 500025, 175975 lies beyond the 54 km about"));
  }
}

}  // namespace
}  // namespace itin
