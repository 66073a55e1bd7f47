// Grids of cells, and the files rasters are written to, read back by GDAL.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <limits>
#include <map>
#include <sys/resource.h>

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <itin/raster.hpp>

#include "support/impatient.hpp"

namespace itin {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST(RasterGrid, AlignsCellEdgesToMultiplesOfTheCellSize) {
  const RasterGrid grid = RasterGrid::aligned({1003, 2001, 1047, 2039}, 10);
  EXPECT_EQ(grid.bounds(), (Box{1000, 2000, 1050, 2040}));
  EXPECT_EQ(grid.columns(), 5);
  EXPECT_EQ(grid.rows(), 4);
  EXPECT_EQ(RasterGrid::aligned({1000, 2000, 1050, 2040}, 10), grid);
  EXPECT_EQ(RasterGrid::aligned({-7, -7, 7, 7}, 5).bounds(), (Box{-10, -10, 10, 10}));
  // 0.1 has no exact double: edges that were meant to be multiples stay edges.
  EXPECT_EQ(RasterGrid::aligned({0.3, 0.6, 0.7, 1.2}, 0.1).columns(), 4);
  EXPECT_EQ(RasterGrid::aligned({5, 5, 5, 5}, 10).cell_count(), 1U);
}

TEST(RasterGrid, CountsRowsFromTheNorth) {
  const RasterGrid grid({1000, 2040}, 10, 20, 5, 2);
  EXPECT_EQ(grid.centre(0, 0), (Point2{1005, 2030}));
  EXPECT_EQ(grid.centre(4, 1), (Point2{1045, 2010}));
  EXPECT_EQ(grid.cell_at({1049.9, 2000.1}), (RasterGrid::Cell{4, 1}));
  EXPECT_EQ(grid.cell_at({1010, 2020}), (RasterGrid::Cell{1, 1}));
  EXPECT_EQ(grid.cell_at({999.9, 2020}), std::nullopt);
  EXPECT_EQ(grid.cell_at({1050, 2020}), std::nullopt);
  EXPECT_EQ(grid.index({4, 1}), 9U);
}

TEST(RasterGrid, RefusesWhatIsNoGrid) {
  EXPECT_THROW(RasterGrid::aligned({}, 10), InputError);
  EXPECT_THROW(RasterGrid::aligned({0, 0, 1, 1}, 0), InputError);
  EXPECT_THROW(RasterGrid::aligned({0, 0, 1, 1}, std::numeric_limits<double>::quiet_NaN()), InputError);
  EXPECT_THROW(RasterGrid::aligned({0, 0, 1e6, 1e6}, 1e-6), InputError);
  EXPECT_THROW(RasterGrid({0, 0}, 1, 1, 0, 5), InputError);
  EXPECT_THROW(RasterGrid({0, 0}, -1, 1, 5, 5), InputError);
}

class RasterFile : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::temp_directory_path() / ("itin-raster-" + std::to_string(getpid()));
    fs::create_directories(directory_);
    GDALAllRegister();
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const std::size_t row = i / 1500;
      const auto c = static_cast<double>(i % 1500), r = static_cast<double>(row);
      values_[i] = c + r < 400 ? 255 : static_cast<std::uint8_t>(std::sin(c / 90) * std::cos(r / 70) > 0.2);
    }
    description_.crs_wkt = "EPSG:27700";
    description_.nodata = 255;
    description_.band_name = "visible";
    description_.classes = {{0, "hidden", {200, 200, 200}}, {1, "visible", {0, 114, 178}}};
    description_.metadata = {{"radius_m", "5000"}};
  }
  void TearDown() override { fs::remove_all(directory_); }
  std::string path(const char* name) const { return (directory_ / name).string(); }
  std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory_), {})); }
  static std::string bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  fs::path directory_;
  RasterGrid grid_{{318000, 186000}, 10, 10, 1500, 1100};
  std::vector<std::uint8_t> values_ = std::vector<std::uint8_t>(1500 * 1100);
  RasterDescription description_;
};

TEST_F(RasterFile, IsAsItWasWhenItsWriterIsCancelled) {
  const auto write = [&](const Progress& progress) {
    write_raster(path("a.tif"), grid_, std::span<const std::uint8_t>(values_), description_, progress);
  };
  const test::Impatient patient(1 << 30);
  write(patient);
  const std::string before = bytes(path("a.tif"));
  description_.overwrite = true;
  values_.assign(values_.size(), 1);
  ASSERT_GT(patient.asked(), 4);  // GDAL asks for each row of tiles
  for (const int looks : {0, 1, patient.asked() / 2}) {
    EXPECT_THROW(write(test::Impatient(looks)), Cancelled) << looks;
    EXPECT_EQ(bytes(path("a.tif")), before) << looks;
    EXPECT_EQ(files(), 1U) << looks;
  }
}

TEST_F(RasterFile, IsACloudOptimisedGeotiffThatSaysWhatItIs) {
  write_raster(path("a.tif"), grid_, std::span<const std::uint8_t>(values_), description_);
  EXPECT_EQ(files(), 1U);
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(path("a.tif").c_str(), GDAL_OF_RASTER));
  ASSERT_TRUE(dataset);
  EXPECT_STREQ(dataset->GetMetadataItem("LAYOUT", "IMAGE_STRUCTURE"), "COG");
  EXPECT_STREQ(dataset->GetMetadataItem("radius_m"), "5000");
  EXPECT_EQ(dataset->GetSpatialRef()->GetAuthorityCode(nullptr), std::string("27700"));
  std::array<double, 6> affine{};
  ASSERT_EQ(dataset->GetGeoTransform(affine.data()), CE_None);
  EXPECT_EQ(affine, (std::array<double, 6>{318000, 10, 0, 186000, 0, -10}));
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  EXPECT_EQ(band.GetNoDataValue(), 255);
  EXPECT_STREQ(band.GetDescription(), "visible");
  EXPECT_STREQ(band.GetMetadataItem("class_1"), "visible");
  ASSERT_TRUE(band.GetColorTable());
  EXPECT_EQ(band.GetColorTable()->GetColorEntry(1)->c3, 178);
  int width = 0, height = 0;
  band.GetBlockSize(&width, &height);
  EXPECT_EQ(width, 512);
  EXPECT_EQ(height, 512);
  std::vector<std::uint8_t> read(values_.size());
  ASSERT_EQ(band.RasterIO(GF_Read, 0, 0, 1500, 1100, read.data(), 1500, 1100, GDT_Byte, 0, 0, nullptr), CE_None);
  EXPECT_EQ(read, values_);
  EXPECT_EQ(raster_grid_like(path("a.tif"), "EPSG:27700"), grid_);
  EXPECT_EQ(raster_grid_like(path("a.tif"), ""), grid_);
  EXPECT_THROW(raster_grid_like(path("a.tif"), "EPSG:32630"), InputError);
}

TEST_F(RasterFile, OverviewsOfClassesHoldTheMostFrequent) {
  write_raster(path("a.tif"), grid_, std::span<const std::uint8_t>(values_), description_);
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(path("a.tif").c_str(), GDAL_OF_RASTER));
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  ASSERT_EQ(band.GetOverviewCount(), 2);
  GDALRasterBand& overview = *band.GetOverview(0);
  ASSERT_EQ(overview.GetXSize(), 750);
  ASSERT_EQ(overview.GetYSize(), 550);
  std::vector<std::uint8_t> read(750 * 550);
  ASSERT_EQ(overview.RasterIO(GF_Read, 0, 0, 750, 550, read.data(), 750, 550, GDT_Byte, 0, 0, nullptr), CE_None);
  for (std::size_t r = 0; r < 550; ++r) {
    for (std::size_t c = 0; c < 750; ++c) {
      std::map<std::uint8_t, int> votes;
      for (const std::size_t i : {0, 1, 1500, 1501}) ++votes[values_[2 * r * 1500 + 2 * c + i]];
      int most = 0;
      for (const auto& [value, count] : votes) most = std::max(most, count);
      ASSERT_EQ(votes[read[r * 750 + c]], most) << r << " " << c;
    }
  }
}

TEST_F(RasterFile, BytesDoNotDependOnThreads) {
  set_thread_count(1);
  write_raster(path("one.tif"), grid_, std::span<const std::uint8_t>(values_), description_);
  set_thread_count(0);
  write_raster(path("all.tif"), grid_, std::span<const std::uint8_t>(values_), description_);
  EXPECT_FALSE(bytes(path("one.tif")).empty());
  EXPECT_EQ(bytes(path("one.tif")), bytes(path("all.tif")));
}

TEST_F(RasterFile, HoldsCountsAndHeights) {
  const RasterGrid grid({0, 20}, 10, 10, 3, 2);
  const std::vector<std::uint16_t> counts{0, 1, 65535, 300, 4, 5};
  const std::vector<float> heights{0, 1.5F, -9999, 3, 4, 5};
  RasterDescription plain;
  plain.nodata = 65535;
  write_raster(path("count.tif"), grid, std::span<const std::uint16_t>(counts), plain);
  plain.nodata = -9999;
  write_raster(path("height.tif"), grid, std::span<const float>(heights), plain);
  std::vector<double> read(6);
  for (const auto& [name, type] : {std::pair{"count.tif", GDT_UInt16}, {"height.tif", GDT_Float32}}) {
    const GDALDatasetUniquePtr dataset(GDALDataset::Open(path(name).c_str(), GDAL_OF_RASTER));
    ASSERT_TRUE(dataset);
    EXPECT_EQ(dataset->GetRasterBand(1)->GetRasterDataType(), type);
    ASSERT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, 3, 2, read.data(), 3, 2, GDT_Float64, 0, 0, nullptr),
              CE_None);
    const auto expected = type == GDT_UInt16 ? std::vector<double>(counts.begin(), counts.end())
                                             : std::vector<double>(heights.begin(), heights.end());
    EXPECT_EQ(read, expected);
  }
}

TEST_F(RasterFile, HoldsSeveralBands) {
  const std::size_t cells = grid_.cell_count();
  std::vector<std::uint32_t> words(3 * cells);
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = static_cast<std::uint32_t>(i * 2654435761U);
  RasterDescription description;
  description.band_name = "one";
  description.further_bands = {"two", "three"};
  write_raster(path("w.tif"), grid_, std::span<const std::uint32_t>(words), description);
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(path("w.tif").c_str(), GDAL_OF_RASTER));
  ASSERT_TRUE(dataset);
  ASSERT_EQ(dataset->GetRasterCount(), 3);
  const int columns = static_cast<int>(grid_.columns()), rows = static_cast<int>(grid_.rows());
  for (int b = 1; b <= 3; ++b) {
    GDALRasterBand& band = *dataset->GetRasterBand(b);
    EXPECT_EQ(band.GetRasterDataType(), GDT_UInt32);
    EXPECT_STREQ(band.GetDescription(), b == 1 ? "one" : b == 2 ? "two" : "three");
    EXPECT_EQ(band.GetOverviewCount(), 2);
    std::vector<std::uint32_t> read(cells);
    ASSERT_EQ(band.RasterIO(GF_Read, 0, 0, columns, rows, read.data(), columns, rows, GDT_UInt32, 0, 0, nullptr),
              CE_None);
    const auto first = words.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(b - 1) * cells);
    EXPECT_TRUE(std::equal(read.begin(), read.end(), first));
    std::uint32_t corner = 0;
    ASSERT_EQ(band.GetOverview(1)->RasterIO(GF_Read, 0, 0, 1, 1, &corner, 1, 1, GDT_UInt32, 0, 0, nullptr), CE_None);
    EXPECT_EQ(corner, *first);
  }
}

TEST_F(RasterFile, IsReplacedOnlyWhereAllowed) {
  std::ofstream(path("a.tif")) << "precious";
  EXPECT_THROW(write_raster(path("a.tif"), grid_, std::span<const std::uint8_t>(values_), description_), FileError);
  EXPECT_EQ(bytes(path("a.tif")), "precious");
  description_.overwrite = true;
  write_raster(path("a.tif"), grid_, std::span<const std::uint8_t>(values_), description_);
  EXPECT_EQ(raster_grid_like(path("a.tif"), ""), grid_);
  EXPECT_EQ(files(), 1U);
}

TEST_F(RasterFile, LeavesNothingBehindWhereItCannotBeWritten) {
  EXPECT_THROW(write_raster(path("none/a.tif"), grid_, std::span<const std::uint8_t>(values_), description_),
               FileError);
  EXPECT_THROW(write_raster(directory_.string(), grid_, std::span<const std::uint8_t>(values_), description_),
               FileError);
  // A full disk, as far as a process can pretend one.
  const auto previous = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{}, small{};
  getrlimit(RLIMIT_FSIZE, &limit);
  small = limit;
  small.rlim_cur = 8192;
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  try {
    write_raster(path("full.tif"), grid_, std::span<const std::uint8_t>(values_), description_);
  } catch (const FileError& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, previous);
  EXPECT_THAT(message, HasSubstr("full.tif: cannot be written"));
  EXPECT_EQ(files(), 0U);
}

TEST_F(RasterFile, WithoutAGridIsRefused) {
  EXPECT_THROW(raster_grid_like(path("missing.tif"), ""), FileError);
  std::ofstream(path("text.tif")) << "no raster";
  EXPECT_THROW(raster_grid_like(path("text.tif"), ""), FileError);
}

}  // namespace
}  // namespace itin
