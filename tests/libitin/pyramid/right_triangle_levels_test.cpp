// A store tells which of its levels have right triangles about the posts of rasters.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

/// Tells whether a triangle has a right angle between two sides of the same length.
bool is_right(const Tin& tin, const Triangle& t) {
  std::array<std::int64_t, 3> squared{};
  for (std::size_t i = 0; i < 3; ++i) {
    const GridPoint &p = tin.vertices[t[i]], &q = tin.vertices[t[(i + 1) % 3]];
    const std::int64_t dx = std::int64_t{p.x} - q.x, dy = std::int64_t{p.y} - q.y;
    squared[i] = dx * dx + dy * dy;
  }
  std::sort(squared.begin(), squared.end());
  return squared[0] == squared[1] && squared[0] + squared[1] == squared[2];
}

class RightTriangleLevels : public testing::Test {
 protected:
  Store store_of(const std::string& name, double rough) {
    const std::string raster = directory_.file(name + ".tif"), path = directory_.file(name + ".itin");
    std::mt19937 random(test::seed());
    test::write_raster(raster, {300000, 200000, 50, 150, 170, 27700}, [&](int c, int r) {
      return 100 * std::sin(c / 60.0) * std::cos(r / 75.0) + rough * static_cast<double>(random() % 1000) / 1000;
    });
    ImportOptions options;
    options.sources = {raster};
    NoProgress progress;
    import_terrain(path, options, progress);
    return Store(path);
  }

  /// Expects right triangles alone in those levels that the store names, and others in the next one.
  static void expect_right_triangles_as_told(const Store& store) {
    const StoreMetadata& metadata = store.metadata();
    ASSERT_TRUE(metadata.right_triangle_levels.has_value());
    const auto told = static_cast<std::size_t>(*metadata.right_triangle_levels);
    for (std::size_t k = 1; k < metadata.levels.size() && k <= told + 1; ++k) {
      NoProgress progress;
      const Tin tin = triangulate(store, Window::all(), Detail::tolerance(metadata.levels[k].tolerance), progress);
      const bool all =
          std::all_of(tin.triangles.begin(), tin.triangles.end(), [&](const Triangle& t) { return is_right(tin, t); });
      EXPECT_EQ(all, k <= told) << "tolerance " << metadata.levels[k].tolerance;
    }
  }

  test::TemporaryDirectory directory_;
};

TEST_F(RightTriangleLevels, AreToldOfRoughGround) {
  const Store store = store_of("rough", 12);
  EXPECT_GT(store.metadata().right_triangle_levels.value_or(0), 0);
  EXPECT_LT(store.metadata().right_triangle_levels.value_or(99), 7);
  expect_right_triangles_as_told(store);
}

TEST_F(RightTriangleLevels, AreNoneOfSmoothGround) {
  const Store store = store_of("smooth", 0);
  EXPECT_EQ(store.metadata().right_triangle_levels, 0);
  expect_right_triangles_as_told(store);
}

}  // namespace
}  // namespace itin
