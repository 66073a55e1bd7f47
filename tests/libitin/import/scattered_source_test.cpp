#include "import/points/scattered_source.hpp"

#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <itin/error.hpp>

#include "import/points/point_source.hpp"
#include "support/las_writer.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using test::LasContents;
using test::TemporaryDirectory;
using ::testing::HasSubstr;

constexpr double kSurveyFoot = 1200.0 / 3937.0;

class ScatteredSource : public testing::Test {
 protected:
  /// Reads a source into a store at 1 cm in the given CRS.
  ReadCounts read(SourceFile& file, const std::string& store_crs, Point2 origin = {}) {
    source_ = file.bind({Grid{origin, 0.01}, parse_crs(store_crs, "test").wkt});
    NoProgress progress;
    return source_->read([&](std::span<const GridPoint> p) { points_.insert(points_.end(), p.begin(), p.end()); },
                         progress);
  }
  /// As bytes of a text file in the CRS of the store.
  ReadCounts read_text(std::string_view content, ImportOptions options = {}) {
    options.crs = "EPSG:27700";
    points_.clear();
    return read(*open_point_source(directory_.write("p.xyz", content), options), "EPSG:27700");
  }

  TemporaryDirectory directory_;
  std::unique_ptr<TerrainSource> source_;
  std::vector<GridPoint> points_;
};

TEST_F(ScatteredSource, PutsPointsOnTheGridAndDescribesThem) {
  const ReadCounts counts = read_text("x,y,z\n0,0,1\n30,0,\n30,40,2.006\n0,40,3\n15,20,-1.5\n");
  EXPECT_EQ(counts.read, 4u);
  EXPECT_EQ(counts.voids, 1u);
  EXPECT_EQ(counts.filtered, 0u);
  EXPECT_EQ(points_, (std::vector<GridPoint>{{0, 0, 100}, {3000, 4000, 201}, {0, 4000, 300}, {1500, 2000, -150}}));
  const SourceInfo info = source_->info();
  EXPECT_EQ(info.path, directory_.file("p.xyz"));
  EXPECT_EQ(info.kind, "terrain");
  EXPECT_EQ(info.source_crs, "EPSG:27700");
  EXPECT_EQ(info.sha256.size(), 64u);
  EXPECT_EQ(info.imported.size(), 20u);
  EXPECT_DOUBLE_EQ(info.spacing, std::sqrt(30.0 * 40 / 4));
  EXPECT_EQ(info.gap_basis, (std::array{100 * info.spacing, 0.0, 0.0, 100 * info.spacing}));
}

TEST_F(ScatteredSource, UsualMarksOfMissingHeightsAreVoids) {
  const ReadCounts counts = read_text("0,0,1\n30,0,-9999\n30,40,2\n0,40,-32768\n15,20,-32767\n9,9,-9998.9\n");
  EXPECT_EQ(counts.read, 3u);
  EXPECT_EQ(counts.voids, 3u);
  EXPECT_THAT(counts.warnings, ::testing::ElementsAre(HasSubstr(
                                   "3 heights of what customarily marks missing data, such as -32767, were taken")));
}

TEST_F(ScatteredSource, GapIsTheOneGiven) {
  ImportOptions options;
  options.max_gap = 12;
  read_text("0 0 1\n30 40 2\n", options);
  EXPECT_EQ(source_->info().gap_basis, (std::array{12.0, 0.0, 0.0, 12.0}));
}

TEST_F(ScatteredSource, SpacingAlongALineIsNotZero) {
  read_text("0 7 1\n10 7 1\n20 7 1\n40 7 2\n");
  EXPECT_DOUBLE_EQ(source_->info().spacing, 10);
}

TEST_F(ScatteredSource, ACrsIsNeeded) {
  const std::string path = directory_.write("p.csv", "x,y,z\n0,0,1\n");
  try {
    open_point_source(path, {})->crs();
    FAIL() << "no CRS, and no complaint";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("`crs`"));
  }
}

TEST_F(ScatteredSource, LongitudeAndLatitudeAreProjected) {
  const std::string path = directory_.write("p.csv", "lon,lat,height\n-3,51.5,10\n-2.99,51.5,11\n");
  const auto file = open_point_source(path, {});
  EXPECT_EQ(file->crs().name, "EPSG:4326");
  EXPECT_FALSE(file->crs().metric());
  read(*file, "EPSG:32630", {0, 5e6});
  // On zone 30's central meridian.
  ASSERT_EQ(points_.size(), 2u);
  EXPECT_EQ(points_[0].x, 50'000'000);
  EXPECT_EQ(points_[0].z, 1000);
  EXPECT_NEAR((points_[1].x - points_[0].x) / 100.0, 694.4, 1);
  EXPECT_NEAR(source_->info().spacing, 347.2, 1);
}

TEST_F(ScatteredSource, FeetBecomeMetres) {
  // Foot-based California zone 5: its origin is at easting 6561666.667 ftUS = 2000000 m.
  LasContents las;
  las.scale = {0.01, 0.01, 0.01};
  las.points = {{656'166'667, 200'000'000, 32'808}};
  const auto keys = [&](const std::vector<std::array<std::uint16_t, 2>>& list) {
    las.vlrs = {{"LASF_Projection", 34735, test::geo_key_directory(list)}};
    points_.clear();
    const auto file = open_las_source(directory_.write("a.las", las_bytes(las)), {});
    EXPECT_EQ(read(*file, "EPSG:26945").read, 1u);
    EXPECT_EQ(points_.at(0).x, 200'000'000);
    EXPECT_EQ(points_.at(0).y, std::lround(2e6 * kSurveyFoot * 100));
    return std::pair(points_.at(0).z, file->warnings().size());
  };
  // Feet are always mentioned.
  EXPECT_EQ(keys({{3072, 2229}, {4099, 9003}}), std::pair(10'000, std::size_t{1}));
  EXPECT_EQ(keys({{3072, 2229}, {4099, 9001}}), std::pair(32'808, std::size_t{0}));
  // Not stated: as the axes.
  EXPECT_EQ(keys({{3072, 2229}}), std::pair(10'000, std::size_t{1}));
}

TEST_F(ScatteredSource, ACompoundCrsStatesTheUnitOfHeights) {
  ImportOptions options;
  options.crs = "EPSG:2229+5703";
  const auto file = open_point_source(directory_.write("p.xyz", "6561666.667 2000000 100\n"), options);
  EXPECT_TRUE(file->warnings().empty());
  read(*file, "EPSG:26945");
  EXPECT_EQ(points_.at(0).z, 10'000);
}

TEST_F(ScatteredSource, RealLidarKeepsEveryPointButNoise) {
  const std::string path = std::string(ITIN_DATA_DIR) + "/derived-las/ign_0299_6802.las";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  const auto file = open_las_source(path, {});
  EXPECT_EQ(file->crs().name, "EPSG:2154");
  EXPECT_NEAR(file->centre().x, 299'500, 1);
  const ReadCounts counts = read(*file, "EPSG:2154", {0, 6e6});
  EXPECT_EQ(counts.read + counts.filtered, 278'810u);
  EXPECT_EQ(counts.voids, 0u);
  EXPECT_NEAR(source_->info().spacing, 1000 / std::sqrt(278'810), 0.01);
  GridBox bounds;
  for (const GridPoint& p : points_) bounds.extend(p.x, p.y);
  EXPECT_EQ(bounds, (GridBox{29'900'000, 80'100'000, 30'000'000, 80'200'000}));
}

TEST_F(ScatteredSource, PlanningFindsTheRightReader) {
  GDALAllRegister();
  const std::string layer = directory_.file("a.gpkg");
  {
    const GDALDatasetUniquePtr json(
        GDALDataset::Open(directory_
                              .write("a.geojson",
                                     R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},
                       "geometry":{"type":"Point","coordinates":[-3,51.5,7]}}]})")
                              .c_str(),
                          GDAL_OF_VECTOR));
    const GDALDatasetUniquePtr copy(
        GetGDALDriverManager()->GetDriverByName("GPKG")->Create(layer.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    ASSERT_TRUE(copy->CopyLayer(json->GetLayer(0), "points"));
  }
  LasContents las;
  las.vlrs = {{"LASF_Projection", 34735, test::geo_key_directory({{2048, 4326}})}};
  las.points = {{-300, 5150, 700}};
  ImportOptions options;
  options.to_crs = "EPSG:32630";
  // A regular lattice, which GDAL would take for a raster.
  const std::string lattice = directory_.write("a.xyz", "lon lat z\n-3 51.5 7\n-2 51.5 7\n-3 51 7\n-2 51 7\n");
  options.sources = {directory_.file("a.geojson"), layer, directory_.write("a.las", las_bytes(las)), lattice};
  const ImportPlan plan = plan_import(options, nullptr);
  ASSERT_EQ(plan.sources.size(), 4u);
  NoProgress progress;
  for (const auto& source : plan.sources)
    source->read([&](std::span<const GridPoint> p) { points_.insert(points_.end(), p.begin(), p.end()); }, progress);
  ASSERT_EQ(points_.size(), 7u);
  for (const GridPoint& p : points_) EXPECT_EQ(p.z, 700);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(points_[i], points_[0]);
}

class CancelAtOnce final : public Progress {
 public:
  void report(std::string_view, double) override {}
  bool cancelled() const override { return true; }
};

TEST_F(ScatteredSource, CanBeCancelled) {
  ImportOptions options;
  options.crs = "EPSG:27700";
  const auto source = open_point_source(directory_.write("p.xyz", "0 0 1\n"), options)
                          ->bind({Grid{}, parse_crs("EPSG:27700", "test").wkt});
  CancelAtOnce progress;
  EXPECT_THROW(source->read([](std::span<const GridPoint>) {}, progress), Cancelled);
}

}  // namespace
}  // namespace itin
