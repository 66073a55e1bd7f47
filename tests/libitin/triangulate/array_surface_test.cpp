// A surface through an array of heights is the surface of a store of that array.
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

std::vector<float> some_heights(const RasterGrid& posts, std::mt19937& random) {
  std::vector<float> heights(posts.cell_count());
  for (float& height : heights)
    height = random() % 7 == 0 ? kNone : static_cast<float>(static_cast<double>(random() % 20000) / 100 - 50);
  return heights;
}

/// The corners of all triangles in metres.
std::vector<std::array<Point3, 3>> triangles_of(const Tin& tin) {
  std::vector<std::array<Point3, 3>> triangles;
  for (const Triangle& t : tin.triangles) triangles.push_back({tin.point(t[0]), tin.point(t[1]), tin.point(t[2])});
  // A store has an origin of its own, by which vertices and so triangles may have another order.
  for (auto& t : triangles)
    std::rotate(
        t.begin(),
        std::min_element(t.begin(), t.end(),
                         [](const Point3& a, const Point3& b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); }),
        t.end());
  std::sort(triangles.begin(), triangles.end(), [](const auto& a, const auto& b) {
    for (std::size_t i = 0; i < 3; ++i)
      if (std::pair(a[i].x, a[i].y) != std::pair(b[i].x, b[i].y))
        return std::pair(a[i].x, a[i].y) < std::pair(b[i].x, b[i].y);
    return false;
  });
  return triangles;
}

TEST(ArraySurface, IsThatOfAStoreOfTheArray) {
  std::mt19937 random(test::seed());
  const test::TemporaryDirectory directory;
  const RasterGrid posts({318000, 176000}, 10, 10, 40, 30);
  const std::vector<float> heights = some_heights(posts, random);
  RasterDescription description;
  description.crs_wkt = "EPSG:27700";
  description.nodata = kNone;
  write_raster(directory.file("a.tif"), posts, std::span<const float>(heights), description);
  ImportOptions options;
  options.sources = {directory.file("a.tif")};
  options.crs = "EPSG:27700";
  NoProgress progress;
  import_terrain(directory.file("a.itin"), options, progress);
  const Tin expected = triangulate(Store(directory.file("a.itin")), Window::all(), Detail::tolerance(0), progress);
  const Tin tin = surface_through(posts, heights);
  const auto ours = triangles_of(tin), theirs = triangles_of(expected);
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_NEAR(ours[i][c].x, theirs[i][c].x, 1e-6);
      ASSERT_NEAR(ours[i][c].y, theirs[i][c].y, 1e-6);
      ASSERT_NEAR(ours[i][c].z, theirs[i][c].z, 1e-6);
    }
  EXPECT_EQ(tin.vertices.size(), expected.vertices.size());
}

TEST(ArraySurface, HasItsVerticesAndTrianglesInOrder) {
  std::mt19937 random(2);
  const RasterGrid posts({-100, 250.5}, 0.5, 2, 17, 12);
  const Tin tin = surface_through(posts, some_heights(posts, random), 0.001);
  for (std::uint32_t v = 1; v < tin.vertices.size(); ++v) EXPECT_LT(tin.id(v - 1), tin.id(v));
  EXPECT_TRUE(std::is_sorted(tin.triangles.begin(), tin.triangles.end()));
  for (const Triangle& t : tin.triangles) {
    EXPECT_LT(t[0], std::min(t[1], t[2]));
    const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
    EXPECT_GT((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), 0);
  }
}

std::string complaint(const RasterGrid& posts, const std::vector<float>& heights, double resolution = 0.01) {
  try {
    surface_through(posts, heights, resolution);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(ArraySurface, SaysWhatMakesNoSurface) {
  using ::testing::HasSubstr;
  const RasterGrid posts({0, 0}, 10, 10, 3, 2);
  EXPECT_THAT(complaint(posts, std::vector<float>(5)), HasSubstr("`heights`: 5 are given for 2 x 3 posts"));
  EXPECT_THAT(complaint(RasterGrid({0, 0}, 10, 10, 6, 1), std::vector<float>(6)),
              HasSubstr("1 x 6 posts span no surface"));
  EXPECT_THAT(complaint(posts, std::vector<float>(6, kNone)), HasSubstr("no three neighbours have heights"));
  EXPECT_THAT(complaint(posts, std::vector<float>(6, 1e9F)), HasSubstr("is beyond the numbers of a grid of 0.01 m"));
  EXPECT_THAT(complaint(posts, std::vector<float>(6), 0), HasSubstr("`resolution`: 0 must be positive"));
  EXPECT_THAT(complaint(posts, std::vector<float>(6), 20), HasSubstr("too coarse"));
  EXPECT_THAT(complaint(posts, std::vector<float>(6), 1e-9), HasSubstr("too fine"));
  EXPECT_EQ(complaint(posts, std::vector<float>(6)), "");
}

}  // namespace
}  // namespace itin
