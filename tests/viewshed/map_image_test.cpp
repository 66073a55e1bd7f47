#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <viewshed/map_image.hpp>

#include "drawing/canvas.hpp"
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

/// There is room for a few names beside a mark: more observers at one place add none.
TEST(MapImage, NamesDoNotCoverEachOther) {
  SurveyedHills s = survey(Mode::kVisible);
  const auto ink = [&](std::size_t names) {
    s.result.request.observers.assign(names, {"Mast", {301000, 201500}, 30});
    const MapImage image =
        draw_map(s.tin, s.result, {.title = "", .subtitle = "x", .observers = "x", .map_pixels = 400});
    std::size_t dark = 0;
    const auto above_the_legend = static_cast<std::size_t>(3) * static_cast<std::size_t>(image.width) * 420;
    for (std::size_t i = 0; i < above_the_legend; i += 3)
      dark += image.rgb[i] < 60 && image.rgb[i + 1] < 60 && image.rgb[i + 2] < 60 ? 1U : 0U;
    return dark;
  };
  EXPECT_GT(ink(2), ink(1));
  EXPECT_EQ(ink(30), ink(12));
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
  MapImage image{3, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {}};
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

TEST(Canvas, BlendsAndClips) {
  Canvas canvas(4, 3, {100, 100, 100});
  canvas.blend(1, 1, {200, 0, 100}, 0.5);
  canvas.blend(-1, 0, {0, 0, 0}, 1);
  canvas.blend(4, 2, {0, 0, 0}, 1);
  const std::vector<std::uint8_t>& rgb = canvas.rgb();
  EXPECT_EQ((std::vector<std::uint8_t>(rgb.begin() + 15, rgb.begin() + 18)), (std::vector<std::uint8_t>{150, 50, 100}));
  EXPECT_EQ(rgb[0], 100);
  EXPECT_EQ(rgb.back(), 100);
  canvas.fill_triangle({{{0, 0}, {2, 0}, {0, 2}}}, {0, 0, 0});
  EXPECT_EQ(rgb[0], 0);
  EXPECT_GT(rgb[3], 30);  // half of the pixel east of it
  EXPECT_LT(rgb[3], 70);
}

}  // namespace
}  // namespace itin::viewshed
