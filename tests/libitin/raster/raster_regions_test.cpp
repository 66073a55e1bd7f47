// Regions of equal value as polygons, read back by GDAL and compared cell by cell.
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <map>
#include <random>

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <itin/error.hpp>
#include <itin/raster_regions.hpp>

#include "support/temporary_directory.hpp"

namespace itin {
namespace {

struct ReadRegion {
  std::string name;
  double area = 0;
  std::unique_ptr<OGRGeometry> shape;
};

std::map<std::uint32_t, ReadRegion> read(const std::string& path, const std::string& layer) {
  GDALAllRegister();
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR));
  std::map<std::uint32_t, ReadRegion> regions;
  for (const OGRFeatureUniquePtr& feature : *dataset->GetLayerByName(layer.c_str())) {
    ReadRegion& region = regions[static_cast<std::uint32_t>(feature->GetFieldAsInteger64("value"))];
    EXPECT_FALSE(region.shape) << "one feature a class";
    region.name = feature->GetFieldAsString("class");
    region.area = feature->GetFieldAsDouble("area_m2");
    region.shape.reset(feature->StealGeometry());
  }
  return regions;
}

class RasterRegions : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }
  test::TemporaryDirectory directory_;
};

TEST_F(RasterRegions, CoverTheirCellsAndNoOthers) {
  // Noise: cells that meet at corners alone, holes in holes, outlines that touch themselves.
  const RasterGrid grid({300000, 200000}, 10, 20, 37, 23);
  std::mt19937 random(5);
  std::vector<std::uint8_t> values(grid.cell_count());
  for (std::uint8_t& v : values) v = static_cast<std::uint8_t>(random() % 4);
  RegionDescription description{"EPSG:27700", "seen", {{2, "two"}, {0, "none"}, {9, "absent"}}, false};
  write_regions(path("a.gpkg"), grid, std::span<const std::uint8_t>(values), description);
  const auto regions = read(path("a.gpkg"), "seen");
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions.at(2).name, "two");
  for (const auto& [value, region] : regions) {
    EXPECT_TRUE(region.shape->IsValid());
    EXPECT_EQ(wkbFlatten(region.shape->getGeometryType()), wkbMultiPolygon);
    std::size_t cells = 0;
    for (std::int64_t row = 0; row < grid.rows(); ++row) {
      for (std::int64_t column = 0; column < grid.columns(); ++column) {
        const Point2 c = grid.centre(column, row);
        const OGRPoint centre(c.x, c.y);
        const bool holds = values[grid.index({column, row})] == value;
        ASSERT_EQ(region.shape->Contains(&centre), holds);
        cells += holds ? 1 : 0;
      }
    }
    EXPECT_DOUBLE_EQ(region.area, static_cast<double>(cells) * 200);
    EXPECT_NEAR(region.shape->toMultiPolygon()->get_Area(), region.area, 1e-3);
  }
}

TEST_F(RasterRegions, OfLargeValuesAndTheSameBytesTwice) {
  const RasterGrid grid({0, 30}, 10, 10, 3, 3);
  const std::vector<std::uint32_t> values{7, 7, 4294967294U, 7, 8, 8, 8, 8, 8};
  const RegionDescription description{"", "seen", {{7, "seven"}, {8, "eight"}}, false};
  const auto bytes = [&](const std::string& name) {
    write_regions(path(name), grid, std::span<const std::uint32_t>(values), description);
    std::ifstream file(path(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(bytes("a.gpkg"), bytes("b.gpkg"));
  EXPECT_EQ(read(path("a.gpkg"), "seen").at(8).area, 500);
  EXPECT_THROW(bytes("a.gpkg"), FileError);
}

TEST_F(RasterRegions, GeoJsonHasTheRegionsOfTheGeoPackage) {
  const RasterGrid grid({300000, 200000}, 10, 20, 17, 13);
  std::mt19937 random(6);
  std::vector<std::uint8_t> values(grid.cell_count());
  for (std::uint8_t& v : values) v = static_cast<std::uint8_t>(random() % 3);
  const RegionDescription description{"EPSG:27700", "seen", {{2, "\"two\""}, {0, "none"}, {9, "absent"}}, false};
  write_regions(path("a.gpkg"), grid, std::span<const std::uint8_t>(values), description);
  write_regions(path("a.geojson"), grid, std::span<const std::uint8_t>(values), description);
  const auto expected = read(path("a.gpkg"), "seen"), regions = read(path("a.geojson"), "seen");
  ASSERT_EQ(regions.size(), expected.size());
  for (const auto& [value, region] : expected) {
    EXPECT_EQ(regions.at(value).name, region.name);
    EXPECT_EQ(regions.at(value).area, region.area);
    EXPECT_TRUE(regions.at(value).shape->Equals(region.shape.get()));
  }
  EXPECT_THROW(write_regions(path("a.geojson"), grid, std::span<const std::uint8_t>(values), description), FileError);
  const RegionDescription local{"LOCAL_CS[\"a plan\"]", "seen", {{2, "two"}}, false};
  EXPECT_THROW(write_regions(path("b.geojson"), grid, std::span<const std::uint8_t>(values), local), InputError);
  EXPECT_FALSE(std::filesystem::exists(path("b.geojson")));
}

}  // namespace
}  // namespace itin
