// What an import settles before it reads a point: kinds, CRS, grid, and every refusal.
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>

#include <itin/error.hpp>

#include "import/crs.hpp"
#include "libitin/import/raster_fixture.hpp"
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
  const ImportPlan made = plan({british(), alpine()});
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
  const ImportPlan made = plan({alpine(), british()});
  EXPECT_EQ(made.crs_name, "EPSG:32632");
  EXPECT_TRUE(made.crs_chosen);
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
      "--to-crs EPSG:27700: the store's CRS is EPSG:32630 already; leave the option out, or import into a new store");
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
              HasSubstr("bad.zip: holds no raster that can be read"));
  EXPECT_THAT(refusal<FileError>({directory_.path()}), HasSubstr(directory_.path() + ": is a directory"));
}

TEST_F(Plan, RefusesWrongCalls) {
  EXPECT_THAT(refusal<InputError>({}), HasSubstr("name at least one source"));
  options_.crs = "EPSG:1";
  EXPECT_THAT(refusal<InputError>({british()}), HasSubstr("--crs: the CRS 'EPSG:1' is not understood"));
  options_.crs.clear();
  options_.to_crs = "EPSG:4326";
  EXPECT_THAT(refusal<InputError>({british()}), HasSubstr("--to-crs: EPSG:4326 is not projected with axes in metres"));
  options_.to_crs.clear();
  for (const double resolution : {0.0, -1.0, 1e-6, 100.0, std::numeric_limits<double>::quiet_NaN()}) {
    options_.resolution = resolution;
    EXPECT_THAT(refusal<InputError>({british()}), HasSubstr("--resolution"));
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
