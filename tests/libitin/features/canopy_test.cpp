// A real wood on real ground: the Environment Agency's canopy heights at 1 m as blocks of vegetation over OS
// Terrain 50.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <random>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "libitin/features/surface_comparison.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

/// Heights above the ground, one per square metre, from the north-western corner.
struct Canopy {
  int columns = 0, rows = 0;
  Point2 corner;
  std::vector<double> heights;

  double at(int column, int row) const {
    return heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)];
  }
};

Canopy read_canopy(const std::string& path) {
  GDALAllRegister();
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
  Canopy canopy;
  if (!dataset) return canopy;
  std::array<double, 6> affine{};
  dataset->GetGeoTransform(affine.data());
  canopy.columns = dataset->GetRasterXSize(), canopy.rows = dataset->GetRasterYSize();
  canopy.corner = {affine[0], affine[3]};
  canopy.heights.resize(static_cast<std::size_t>(canopy.columns) * static_cast<std::size_t>(canopy.rows));
  EXPECT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, canopy.columns, canopy.rows, canopy.heights.data(),
                                                canopy.columns, canopy.rows, GDT_Float64, 0, 0, nullptr),
            CE_None);
  for (double& h : canopy.heights) h = h >= 0 && h < 100 ? h : 0;
  return canopy;
}

constexpr int kSide = 24;
constexpr double kLeast = 2;  ///< metres: lower is no wood

double mean_height(const Canopy& canopy, int column, int row) {
  double sum = 0;
  for (int r = 0; r < kSide; ++r)
    for (int c = 0; c < kSide; ++c) sum += canopy.at(column + c, row + r);
  return sum / (kSide * kSide);
}

TEST(Canopy, FingleWoodsStandAsHighAsTheyWereMeasured) {
  const std::string data = std::string(ITIN_DATA_DIR) + "/ea-vom-dartmoor-newforest/";
  const Canopy canopy = std::filesystem::exists(data) ? read_canopy(data + "fingle_woods_vom.tif") : Canopy{};
  if (canopy.heights.empty()) GTEST_SKIP() << data << " is not there";
  std::vector<test::LineFeature> blocks;
  for (int row = 0; row + kSide <= canopy.rows; row += kSide) {
    for (int column = 0; column + kSide <= canopy.columns; column += kSide) {
      const double height = mean_height(canopy, column, row);
      if (height < kLeast) continue;
      const double west = canopy.corner.x + column, north = canopy.corner.y - row, east = west + kSide,
                   south = north - kSide;
      test::LineFeature& block = blocks.emplace_back();
      block.polygon = true;
      block.vertices = {{west, south, 0}, {east, south, 0}, {east, north, 0}, {west, north, 0}, {west, south, 0}};
      block.properties = fmt::format(R"({{"h":{:.3f}}})", height);
    }
  }
  const test::TemporaryDirectory directory;
  const std::string store_path = directory.file("s.itin");
  NoProgress progress;
  ImportOptions options;
  options.sources = {data + "tiles/sx78.zip", data + "tiles/sx79.zip"};
  import_terrain(store_path, options, progress);
  test::write_lines(directory.file("wood.geojson"), blocks, true);
  options.sources = {directory.file("wood.geojson")};
  options.kind = ThemeKind::Vegetation;
  options.theme = "wood";
  options.height_field = "h";
  const ImportReport report = import_lines(store_path, options, progress);
  EXPECT_EQ(report.features, blocks.size());

  const Store store(store_path);
  const Window window = Window::box({canopy.corner.x - 50, canopy.corner.y - canopy.rows - 50,
                                     canopy.corner.x + canopy.columns + 50, canopy.corner.y + 50});
  const Tin bare = triangulate(store, window, Detail::tolerance(0), progress, ThemeChoice::none());
  const Tin tin = triangulate(store, window, Detail::tolerance(0), progress, ThemeChoice::all());
  const TerrainHeights low(bare), high(tin);
  std::vector<double> errors;
  double rise = 0, measured = 0;
  for (int row = 0; row + kSide <= canopy.rows; row += kSide) {
    for (int column = 0; column + kSide <= canopy.columns; column += kSide) {
      const double height = mean_height(canopy, column, row);
      for (const int off : {4, 11, 19}) {
        const GridPoint p =
            bare.grid.quantise({canopy.corner.x + column + off + 0.5, canopy.corner.y - row - kSide + off + 0.5, 0});
        const double above = *high.height_at({p.x, p.y}) - *low.height_at({p.x, p.y});
        errors.push_back(std::abs(above - (height < kLeast ? 0 : height)));
        rise += above;
        measured += canopy.at(column + off, row + kSide - 1 - off);
      }
    }
  }
  const double worst = *std::max_element(errors.begin(), errors.end());
  const auto count = static_cast<double>(errors.size());
  std::cout << blocks.size() << " blocks in " << report.seconds << " s; mean canopy " << rise / count << " m, measured "
            << measured / count << " m at the same " << errors.size() << " places; off their blocks' by up to " << worst
            << " m\n";
  EXPECT_LT(worst, 0.03);
  EXPECT_NEAR(rise / measured, 1, 0.1);
  std::mt19937 random(test::seed());
  test::SurfaceComparison comparison(bare, tin);
  comparison.everywhere(random);
  comparison.expect_only_raised();
  comparison.expect_ground_kept();
}

}  // namespace
}  // namespace itin
