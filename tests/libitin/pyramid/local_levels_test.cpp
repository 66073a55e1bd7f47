// Levels are local: where terrain far away changes or comes, points keep the levels that they have.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "support/raster_file.hpp"
#include "support/sound_store.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

/// Posts are 50 m apart, so that a work cell has 210 of them across.
constexpr int kColumns = 800, kRows = 300;
/// The columns in the west that change.
constexpr int kExchanged = 100;
/// No level may change farther away than three work cells, in posts. Proposals look no farther than that and the reach
/// of the hierarchy (kReachesOfProposal); changes that mending takes on from cell to cell die out before.
constexpr int kFar = 3 * 210;

using Terrain = std::function<double(int, int)>;

class LocalLevels : public testing::Test {
 protected:
  /// Imports a terrain from a column on.
  Store store_of(const std::string& name, const Terrain& terrain, int first) {
    const std::string raster = directory_.file(name + ".tif"), path = directory_.file(name + ".itin");
    test::write_raster(raster, {300000 + 50.0 * first, 200000, 50, kColumns - first, kRows, 27700},
                       [&](int c, int r) { return terrain(c + first, r); });
    ImportOptions options;
    options.sources = {raster};
    NoProgress progress;
    import_terrain(path, options, progress);
    return Store(path);
  }

  /// A level's vertices, in whole posts from the corner of the whole terrain.
  static std::vector<Position> vertices(const Store& store, const LevelInfo& level) {
    NoProgress progress;
    const Tin tin = triangulate(store, Window::all(), Detail::tolerance(level.tolerance), progress);
    std::vector<Position> posts;
    for (const GridPoint& v : tin.vertices) {
      const Point3 p = tin.grid.point(v);
      posts.push_back({static_cast<std::int32_t>(std::lround((p.x - 300025) / 50)),
                       static_cast<std::int32_t>(std::lround((p.y - 199975) / 50))});
    }
    std::sort(posts.begin(), posts.end());
    return posts;
  }

  /// Compares two stores that differ in the exchanged columns.
  static void expect_same_levels_far_away(const Store& before, const Store& after) {
    std::size_t far = 0, changed = 0;
    for (const LevelInfo& level : before.metadata().levels) {
      const std::vector<Position> old = vertices(before, level), now = vertices(after, level);
      std::vector<Position> different;
      std::set_symmetric_difference(old.begin(), old.end(), now.begin(), now.end(), std::back_inserter(different));
      for (const Position& p : different)
        EXPECT_LT(p.x, kExchanged + kFar) << "row " << p.y << ", tolerance " << level.tolerance;
      changed += different.size();
      far += static_cast<std::size_t>(
          std::count_if(old.begin(), old.end(), [](const Position& p) { return p.x >= kExchanged + kFar; }));
    }
    EXPECT_GT(far, 0U);
    EXPECT_GT(changed, 0U);
  }

  test::TemporaryDirectory directory_;
};

TEST_F(LocalLevels, OnRealTerrain) {
  const test::CardiffTerrain cardiff;
  const Terrain here = [&](int c, int r) { return cardiff(c, r); };
  const Terrain exchanged = [&](int c, int r) { return cardiff(c, c < kExchanged ? 799 - r : r); };
  const Store before = store_of("before", here, 0);
  test::expect_sound(before);
  expect_same_levels_far_away(before, store_of("exchanged", exchanged, 0));
  expect_same_levels_far_away(before, store_of("without", here, kExchanged));
}

TEST_F(LocalLevels, OnTerrainAtRandom) {
  // The choice of fine levels is of the whole. Over this terrain it is the same for all three stores.
  std::mt19937 random(57);
  const double wave = 20 + static_cast<double>(random() % 40), rough = static_cast<double>(random() % 20);
  std::vector<double> noise(std::size_t{kColumns} * kRows);
  for (double& n : noise) n = static_cast<double>(random() % 1000) / 1000;
  const auto noise_at = [&](int c, int r) { return noise[static_cast<std::size_t>(r * kColumns + c)]; };
  const Terrain here = [&](int c, int r) {
    return 150 * std::sin(c / wave) * std::cos(r / wave * 1.3) + rough * noise_at(c, r);
  };
  const Terrain exchanged = [&](int c, int r) {
    return c < kExchanged ? here(c, r) + 50 * noise_at(r, c % kRows) : here(c, r);
  };
  const Store before = store_of("before", here, 0);
  test::expect_sound(before);
  expect_same_levels_far_away(before, store_of("exchanged", exchanged, 0));
  expect_same_levels_far_away(before, store_of("without", here, kExchanged));
}

}  // namespace
}  // namespace itin
