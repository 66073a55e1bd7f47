#include "bounds/pixel_heights.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "bounds/surface_heights.hpp"
#include "support/seed.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

TEST(PixelHeights, OfALatticeAreThoseOfItsTriangles) {
  std::mt19937 random(test::seed());
  const std::vector<double> z = test::fractal_heights(129, 60, 0.5, random());
  const Tin tin = test::lattice_tin(129, 129, 50, [&](std::int32_t c, std::int32_t r) {
    return (c / 9 + r / 13) % 6 == 0 ? NAN : z[static_cast<std::size_t>(r) * 129 + static_cast<std::size_t>(c)];
  });
  const auto lattice = lattice_of(tin);
  ASSERT_TRUE(lattice);
  // Also beyond the surface, finer and coarser than its posts.
  for (const double pixel : {17.0, 230.0}) {
    const Point2 corner{299500 + 0.1 * pixel, 207000 + 0.1 * pixel};
    const auto side = static_cast<std::int64_t>(7500 / pixel);
    const RasterGrid pixels(corner, pixel, pixel, side, side);
    const std::vector<float> expected = heights_at(tin, pixels), found = heights_at(*lattice, pixels);
    int ground = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_EQ(std::isnan(found[i]), std::isnan(expected[i])) << i;
      if (std::isnan(found[i])) continue;
      ++ground;
      EXPECT_NEAR(found[i], expected[i], 1e-4);
    }
    EXPECT_GT(ground, 300);
    EXPECT_LT(static_cast<std::size_t>(ground), expected.size());
  }
}

TEST(PixelHeights, AreThoseOfTheSurfaceAtTheCentres) {
  const Tin tin = test::fractal_tin(17, 50, 60, 0.5, test::seed());
  const RasterGrid pixels({300010, 200790}, 33, 31, 20, 20);
  const std::vector<float> heights = heights_at(tin, pixels);
  for (std::int64_t r = 0; r < 20; ++r)
    for (std::int64_t c = 0; c < 20; ++c)
      EXPECT_NEAR(heights[pixels.index({c, r})], height_on(tin, pixels.centre(c, r)).value(), 1e-4);
}

}  // namespace
}  // namespace itin::viewshed
