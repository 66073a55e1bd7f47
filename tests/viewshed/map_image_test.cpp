#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <unistd.h>

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <viewshed/map_image.hpp>

#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

namespace fs = std::filesystem;

struct SurveyedHills {
  Tin tin;
  Result result;
};

SurveyedHills survey(Mode mode) {
  SurveyedHills s{test::fractal_tin(65, 50, 200, 0.5, 9), {}};
  Request request;
  request.observers = {{"Mast", {301000, 201500}, 30}, {"Tower", {302000, 201000}, 30}};
  request.cell_size = 25;
  request.mode = mode;
  NoProgress progress;
  s.result = compute(s.tin, request, progress);
  return s;
}

/// Blue clearly above red: the overlay's hue, which nothing else on the map has.
std::size_t blue_pixels(const MapImage& map) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < map.rgb.size(); i += 3) count += map.rgb[i + 2] > map.rgb[i] + 40;
  return count;
}

TEST(MapImage, ShowsAsMuchBlueAsIsVisible) {
  const SurveyedHills s = survey(Mode::kVisible);
  const MapImage map = draw_map(s.tin, s.result, {.title = "A map", .subtitle = "", .map_pixels = 640});
  EXPECT_EQ(map.rgb.size(), 3U * static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
  EXPECT_GE(map.width, 640);
  const double share = static_cast<double>(s.result.cells.visible) / static_cast<double>(s.result.grid.cell_count());
  EXPECT_NEAR(static_cast<double>(blue_pixels(map)) / (640.0 * 640.0), share, 0.02);
}

TEST(MapImage, DrawsCountsInSteps) {
  const SurveyedHills s = survey(Mode::kCount);
  EXPECT_GT(blue_pixels(draw_map(s.tin, s.result, {.title = "Counts", .subtitle = "", .map_pixels = 400})), 1000U);
}

/// Cells without ground are striped, as nothing else is.
TEST(MapImage, GroundWithoutDataLooksLikeNothingElse) {
  const SurveyedHills s = survey(Mode::kVisible);
  const auto striped = [&](const MapOptions& options) {
    const MapImage image = draw_map(s.tin, s.result, options);
    std::size_t pixels = 0;
    for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3)
      pixels += image.rgb[i] == 170 && image.rgb[i + 1] == 170 && image.rgb[i + 2] == 170 ? 1U : 0U;
    return pixels;
  };
  MapOptions options;
  options.map_pixels = 400;
  const std::size_t before = striped(options);
  options.no_data.assign(s.result.grid.cell_count(), 0);
  EXPECT_EQ(striped(options), before);
  std::fill_n(options.no_data.begin(), options.no_data.size() / 4, 1);
  const std::size_t pixels = striped(options);  // a quarter of 160,000 pixels, and a key
  EXPECT_GT(pixels, before + 5000);
  EXPECT_LT(pixels, before + 20000);
}

/// Observers' names stand on the map.
TEST(MapImage, NamesObservers) {
  SurveyedHills s = survey(Mode::kVisible);
  const auto drawn = [&](const std::string& name) {
    s.result.request.observers.assign(1, {name, {301000, 201500}, 30});
    return draw_map(s.tin, s.result, {.title = "", .subtitle = "x", .observers = "x", .map_pixels = 800});
  };
  const MapImage named = drawn("MM"), nameless = drawn("");
  ASSERT_EQ(named.rgb.size(), nameless.rgb.size());
  EXPECT_GT(std::inner_product(named.rgb.begin(), named.rgb.end(), nameless.rgb.begin(), std::size_t{0}, std::plus<>(),
                               [](int x, int y) { return std::size_t{x != y}; }),
            100U);
}

/// However long the legend and however low the map, everything has room.
TEST(MapImage, GrowsWithItsLegend) {
  const SurveyedHills s = survey(Mode::kVisible);
  MapOptions options{.title = "A map", .map_pixels = 400};
  const MapImage brief = draw_map(s.tin, s.result, options);
  for (int i = 0; i < 40; ++i)
    options.sources.push_back("a survey of the ground with a long name, number " + std::to_string(i));
  const MapImage full = draw_map(s.tin, s.result, options);
  EXPECT_EQ(full.width, brief.width);
  EXPECT_GT(full.height, brief.height + 150);
}

TEST(MapImage, RefusesSizesOutOfRange) {
  const SurveyedHills s = survey(Mode::kVisible);
  EXPECT_THROW(draw_map(s.tin, s.result, {.title = "", .subtitle = "", .map_pixels = 199}), InputError);
  EXPECT_THROW(draw_map(s.tin, s.result, {.title = "", .subtitle = "", .map_pixels = 16001}), InputError);
}

TEST(MapImage, IsWrittenWholeOrNotAtAll) {
  const fs::path directory = fs::temp_directory_path() / ("itin-map-" + std::to_string(getpid()));
  fs::create_directories(directory);
  const std::string path = (directory / "map.png").string();
  MapImage image{3, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 1, 2, 3, 4, 5, 6, 7, 8, 9}};
  write_image(path, image, false);
  EXPECT_THROW(write_image(path, image, false), FileError);
  image.rgb[0] = 128;
  write_image(path, image, true);
  EXPECT_THROW(write_image((directory / "map.nonsense").string(), image, false), InputError);
  EXPECT_THROW(write_image((directory / "none" / "map.png").string(), image, false), FileError);
  EXPECT_EQ(std::distance(fs::directory_iterator(directory), {}), 1);
  GDALAllRegister();
  const GDALDatasetUniquePtr read(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->GetRasterCount(), 3);
  std::uint8_t first = 0;
  ASSERT_EQ(read->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, 1, 1, &first, 1, 1, GDT_Byte, 0, 0, nullptr), CE_None);
  EXPECT_EQ(first, 128);
  fs::remove_all(directory);
}

}  // namespace
}  // namespace itin::viewshed
