// Law 2 against brute force on real terrain: the difference between the full surface and a coarse one, at every vertex
// of the overlay of both, lies within the certificates of every box that holds it.
#include <filesystem>
#include <random>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "support/overlay_samples.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/sound_store.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

using test::overlay, test::Sample;

void expect_certified(const Store& store, unsigned seed) {
  std::mt19937 random(seed);
  NoProgress progress;
  test::expect_sound(store);
  const Tin fine = triangulate(store, Window::all(), Detail::tolerance(0), progress);
  const Box bounds = fine.bounds();
  for (std::size_t k = 1; k < store.metadata().levels.size(); ++k) {
    const LevelInfo& level = store.metadata().levels[k];
    EXPECT_GE(level.certified_error.lo, -level.tolerance);
    EXPECT_LE(level.certified_error.hi, level.tolerance);
    const Tin coarse = triangulate(store, Window::all(), Detail::tolerance(level.tolerance), progress);
    const std::vector<Sample> samples = overlay(fine, coarse);
    double lo = 0, hi = 0;
    for (const Sample& s : samples) lo = std::min(lo, s.difference), hi = std::max(hi, s.difference);
    // Tight, too: the level's certificate is no wider than its worst sample, but for rounding to the grid.
    EXPECT_NEAR(level.certified_error.lo, lo, 0.0101) << "level " << k;
    EXPECT_NEAR(level.certified_error.hi, hi, 0.0101) << "level " << k;
    for (int i = 0; i < 200; ++i) {
      const auto in = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() % 1000) / 1000;
      };
      const double x = in(bounds.xmin, bounds.xmax), y = in(bounds.ymin, bounds.ymax), side = in(1, 1500);
      const Box box{x, y, x + side, y + side};
      const auto certified = store.certified_error(static_cast<int>(k), box);
      for (const Sample& s : samples) {
        if (!box.contains(s.position)) continue;
        ASSERT_TRUE(certified.has_value());
        ASSERT_GE(s.difference, certified->lo - 1e-7) << "level " << k << ", seed " << seed;
        ASSERT_LE(s.difference, certified->hi + 1e-7) << "level " << k << ", seed " << seed;
      }
    }
  }
}

TEST(Certificate, HoldsOnRealTerrainWithAndWithoutVoids) {
  const test::TemporaryDirectory directory;
  const test::CardiffTerrain terrain;
  const auto none = [](int, int) { return false; };
  const auto round = [](int c, int r) { return (c - 20) * (c - 20) + (r - 25) * (r - 25) < 40; };
  // Pieces of ground that meet only at a post.
  const auto ragged = [](int c, int r) { return (c * 7919 + r * 104729 + c * r * 31) % 10 < 4; };
  for (const std::function<bool(int, int)>& is_void : std::vector<std::function<bool(int, int)>>{none, round, ragged}) {
    const std::string raster = directory.file("t.tif"), path = directory.file("t.itin");
    std::filesystem::remove(path);
    test::write_raster(raster, {300000, 200000, 50, 46, 44, 27700},
                       [&](int c, int r) { return is_void(c, r) ? std::nan("") : terrain(c + 150, r + 250); });
    ImportOptions options;
    options.sources = {raster};
    NoProgress progress;
    import_terrain(path, options, progress);
    expect_certified(Store(path), test::seed());
  }
}

TEST(Certificate, HoldsWithLinesOfTheTerrain) {
  std::mt19937 random(test::seed());
  const auto in = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 100000) / 100000;
  };
  const test::TemporaryDirectory directory;
  const test::CardiffTerrain terrain;
  for (const bool cliffs : {false, true}) {
    const std::string raster = directory.file("t.tif"), lines = directory.file("l.geojson"),
                      path = directory.file("t.itin");
    std::filesystem::remove(path);
    test::write_raster(raster, {300000, 200000, 50, 36, 34, 27700},
                       [&](int c, int r) { return terrain(c + 150, r + 250); });
    // Winding lines on the terrain, and some that are far above it and below.
    std::vector<test::LineFeature> features;
    for (int i = 0; i < 8; ++i) {
      test::LineFeature f;
      Point3 p{in(300300, 301500), in(198500, 199700), 0};
      double heading = in(0, 6.28);
      for (int k = 0; k < 40; ++k) {
        const double ground =
            terrain(static_cast<int>((p.x - 300000) / 50) + 150, static_cast<int>((200000 - p.y) / 50) + 250);
        f.vertices.push_back({p.x, p.y, ground + (cliffs ? in(-20, 20) : 0)});
        heading += in(-0.7, 0.7);
        p = {p.x + 12 * std::cos(heading), p.y + 12 * std::sin(heading), 0};
      }
      features.push_back(f);
    }
    test::write_lines(lines, features);
    ImportOptions options;
    options.sources = {raster};
    NoProgress progress;
    import_terrain(path, options, progress);
    options.sources = {lines};
    options.kind = ThemeKind::Breaklines;
    import_lines(path, options, progress);
    expect_certified(Store(path), test::seed());
  }
}

}  // namespace
}  // namespace itin
