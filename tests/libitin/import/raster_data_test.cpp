// Real rasters against the slow reading.
#include <filesystem>
#include <gmock/gmock.h>

#include <itin/error.hpp>

#include "libitin/import/raster_fixture.hpp"

namespace itin {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string data_file(const std::string& name) {
  return std::string(ITIN_DATA_DIR) + "/" + name;
}

class RasterData : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(data_file("README.md"))) GTEST_SKIP() << ITIN_DATA_DIR << " is absent";
  }

  test::Reading expect_exact(const std::string& path, const test::SlowRules& rules = {}, ImportOptions options = {}) {
    options.sources = {path};
    plan_ = plan_import(options, nullptr);
    EXPECT_EQ(plan_.sources.size(), 1U);
    test::Reading reading = test::read(*plan_.sources.at(0));
    test::expect_same(reading, test::read_slowly(reading.info.path, plan_, rules));
    return reading;
  }

  ImportPlan plan_;
};

TEST_F(RasterData, EverestHasVoids) {
  const test::Reading reading = expect_exact(data_file("srtm90-alpine/mt_everest_90m.tif"));
  EXPECT_EQ(plan_.crs_name, "EPSG:32645");
  EXPECT_TRUE(plan_.crs_chosen);
  EXPECT_NEAR(static_cast<double>(reading.counts.voids) / (1201.0 * 1201), 0.091, 0.001);
  EXPECT_THAT(reading.counts.warnings, IsEmpty());
  EXPECT_NEAR(reading.info.spacing, 87.5, 0.5);  // 92.4 m by 82.9 m
  EXPECT_EQ(reading.info.sha256.substr(0, 16), "32e39fe23d9dcd74");
}

TEST_F(RasterData, SaintHelensIsAUsgsDem) {
  const test::Reading reading = expect_exact(data_file("dem30-misc/SainteHelens.dem"));
  EXPECT_EQ(plan_.crs_name, "EPSG:26710");
  EXPECT_THAT(reading.info.gap_basis, ElementsAre(45, 0, 0, -45));
  EXPECT_NEAR(static_cast<double>(reading.counts.voids) / (327.0 * 468), 0.027, 0.001);
  EXPECT_THAT(plan_.warnings, IsEmpty());
}

TEST_F(RasterData, OddNodataValuesEarnNoWarning) {
  for (const char* name : {"dem30-misc/bigtujunga.tif", "dem30-misc/elev_vinschgau.tif", "dem30-misc/hobart_dem_01.tif",
                           "alexandria-va-2m/dtm.tif", "bilbao-dem-bdsm-cdsm/DEM.tif"}) {
    SCOPED_TRACE(name);
    const test::Reading reading = expect_exact(data_file(name));
    EXPECT_FALSE(plan_.crs_chosen);
    EXPECT_THAT(plan_.warnings, IsEmpty());
    EXPECT_THAT(reading.counts.warnings, IsEmpty());
  }
}

TEST_F(RasterData, SlottskogenNeedsACrs) {
  ImportOptions options;
  options.sources = {data_file("dem30-misc/Slottskogen.asc.zip")};
  try {
    plan_import(options, nullptr);
    FAIL() << "no exception";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("Slottskogen.asc: does not say its CRS; give it with `crs` EPSG:xxxx"));
  }
  options.crs = "EPSG:3006";
  const test::Reading reading = expect_exact(options.sources.front(), {1, "EPSG:3006"}, options);
  EXPECT_DOUBLE_EQ(reading.info.spacing, 0.5);
}

TEST_F(RasterData, TilesOfTerrain50DoNotOverlap) {
  ImportOptions options;
  options.sources = {data_file("os-terrain50-wales/tiles/st17.zip"), data_file("os-terrain50-wales/tiles/st18.zip")};
  ImportPlan plan = plan_import(options, nullptr);
  EXPECT_EQ(plan.crs_name, "EPSG:27700");
  EXPECT_EQ(plan.grid, (Grid{{0, 0}, 0.01}));
  ASSERT_EQ(plan.sources.size(), 2U);
  std::vector<GridPoint> all;
  for (const auto& source : plan.sources) {
    const test::Reading reading = test::read(*source);
    test::expect_same(reading, test::read_slowly(reading.info.path, plan));
    EXPECT_EQ(reading.points.size(), 40000U);
    EXPECT_THAT(reading.info.gap_basis, ElementsAre(75, 0, 0, -75));
    EXPECT_EQ(reading.info.source_crs, "EPSG:27700");
    all.insert(all.end(), reading.points.begin(), reading.points.end());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all.front().x, 31002500);
  EXPECT_EQ(all.back().x, 31997500);
  EXPECT_EQ(std::adjacent_find(all.begin(), all.end(),
                               [](const GridPoint& a, const GridPoint& b) { return a.x == b.x && a.y == b.y; }),
            all.end());
}

TEST_F(RasterData, AnnArborIsInFeet) {
  const test::Reading reading =
      expect_exact(data_file("annarbor-viewscape/test_dtm.tif"), {.metres_per_height = 0.3048});
  EXPECT_EQ(plan_.crs_name, "EPSG:26917");
  EXPECT_THAT(plan_.warnings, ElementsAre(HasSubstr("the unit of heights is not stated; taken as that of the "
                                                    "coordinates, 0.3048 m")));
  EXPECT_NEAR(reading.info.spacing, 2 * 0.3048, 0.001);

  ImportOptions metres;
  metres.crs = "EPSG:2253+5703";
  expect_exact(data_file("annarbor-viewscape/test_dtm.tif"), {.metres_per_height = 1}, metres);
  EXPECT_THAT(plan_.warnings, IsEmpty());
}

}  // namespace
}  // namespace itin
