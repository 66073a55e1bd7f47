// Pictures for pages, read back by GDAL.
#include <cmath>
#include <random>
#include <vector>

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <viewshed/picture_bytes.hpp>

#include "support/seed.hpp"

namespace itin::viewshed {
namespace {

/// The samples of the file, pixel by pixel.
std::vector<std::uint8_t> read_back(const std::string& bytes, const char* name, int width, int height, int channels) {
  GDALAllRegister();
  const std::string path = std::string("/vsimem/") + name;
  std::vector<std::uint8_t> content(bytes.begin(), bytes.end());
  VSIFCloseL(VSIFileFromMemBuffer(path.c_str(), content.data(), content.size(), FALSE));
  std::vector<std::uint8_t> samples(static_cast<std::size_t>(width * height * channels));
  auto* const picture = GDALDataset::Open(path.c_str(), GDAL_OF_RASTER);
  EXPECT_NE(picture, nullptr);
  EXPECT_EQ(picture->GetRasterXSize(), width);
  EXPECT_EQ(picture->GetRasterYSize(), height);
  EXPECT_EQ(picture->GetRasterCount(), channels);
  EXPECT_EQ(picture->RasterIO(GF_Read, 0, 0, width, height, samples.data(), width, height, GDT_Byte, channels, nullptr,
                              channels, static_cast<GSpacing>(channels) * width, 1, nullptr),
            CE_None);
  GDALClose(picture);
  VSIUnlink(path.c_str());
  return samples;
}

TEST(PictureBytes, KeepEverySampleOfAPngWithAlpha) {
  std::mt19937 random(test::seed());
  std::vector<std::uint8_t> samples(4 * 37 * 23);
  for (std::uint8_t& v : samples) v = static_cast<std::uint8_t>(random());
  EXPECT_EQ(read_back(picture_bytes({samples, 37, 23, 4}, "a.png"), "a.png", 37, 23, 4), samples);
}

TEST(PictureBytes, KeepGreysOfAJpegNearlyInAFewBytes) {
  constexpr int kPictureSide = 300;
  std::vector<std::uint8_t> samples;
  for (int row = 0; row < kPictureSide; ++row) {
    for (int column = 0; column < kPictureSide; ++column)
      samples.push_back(static_cast<std::uint8_t>(180 + 50 * std::sin(column / 9.0) * std::cos(row / 14.0)));
  }
  const std::string bytes = picture_bytes({samples, kPictureSide, kPictureSide, 1}, "b.jpeg", 80);
  EXPECT_LT(bytes.size(), samples.size() / 8);
  EXPECT_LT(bytes.size(), picture_bytes({samples, kPictureSide, kPictureSide, 1}, "b.jpeg").size());
  const std::vector<std::uint8_t> read = read_back(bytes, "b.jpeg", kPictureSide, kPictureSide, 1);
  for (std::size_t i = 0; i < samples.size(); ++i) ASSERT_NEAR(read[i], samples[i], 12) << i;
}

TEST(PictureBytes, NameAFormatThatNobodyKnows) {
  const std::vector<std::uint8_t> grey(4);
  EXPECT_THROW(picture_bytes({grey, 2, 2, 1}, "c.nothing"), FileError);
}

}  // namespace
}  // namespace itin::viewshed
