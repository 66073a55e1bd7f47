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
constexpr int kRows = 300;
/// No level may change farther away than three work cells, in posts. Proposals look no farther than that and the reach
/// of the hierarchy (kReachesOfProposal); changes that mending takes on from cell to cell die out before.
constexpr int kFar = 3 * 210;

using Terrain = std::function<double(int, int)>;

class LocalLevels : public testing::Test {
 protected:
  /// Imports a terrain from a column on, of `columns_` in all.
  Store store_of(const std::string& name, const Terrain& terrain, int first) {
    const std::string raster = directory_.file(name + ".tif"), path = directory_.file(name + ".itin");
    test::write_raster(raster, {300000 + 50.0 * first, 200000, 50, columns_ - first, kRows, 27700},
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
  void expect_same_levels_far_away(const Store& before, const Store& after) const {
    std::size_t far = 0, changed = 0;
    for (const LevelInfo& level : before.metadata().levels) {
      const std::vector<Position> old = vertices(before, level), now = vertices(after, level);
      std::vector<Position> different;
      std::set_symmetric_difference(old.begin(), old.end(), now.begin(), now.end(), std::back_inserter(different));
      for (const Position& p : different)
        EXPECT_LT(p.x, exchanged_ + kFar) << "row " << p.y << ", tolerance " << level.tolerance;
      changed += different.size();
      far += static_cast<std::size_t>(
          std::count_if(old.begin(), old.end(), [&](const Position& p) { return p.x >= exchanged_ + kFar; }));
    }
    EXPECT_GT(far, 0U);
    EXPECT_GT(changed, 0U);
  }

  int columns_ = 800;
  int exchanged_ = 100;  ///< the columns in the west that change

 private:
  test::TemporaryDirectory directory_;
};

TEST_F(LocalLevels, OnRealTerrain) {
  const test::CardiffTerrain cardiff;
  const Terrain here = [&](int c, int r) { return cardiff(c, r); };
  const Terrain exchanged = [&](int c, int r) { return cardiff(c, c < exchanged_ ? 799 - r : r); };
  const Store before = store_of("before", here, 0);
  test::expect_sound(before);
  expect_same_levels_far_away(before, store_of("exchanged", exchanged, 0));
  expect_same_levels_far_away(before, store_of("without", here, exchanged_));
}

TEST_F(LocalLevels, OnTerrainAtRandom) {
  std::mt19937 random(57);
  const double wave = 20 + static_cast<double>(random() % 40), rough = static_cast<double>(random() % 20);
  std::vector<double> noise(static_cast<std::size_t>(columns_) * kRows);
  for (double& n : noise) n = static_cast<double>(random() % 1000) / 1000;
  const auto noise_at = [&](int c, int r) { return noise[static_cast<std::size_t>(r * columns_ + c)]; };
  const Terrain here = [&](int c, int r) {
    return 150 * std::sin(c / wave) * std::cos(r / wave * 1.3) + rough * noise_at(c, r);
  };
  const Terrain exchanged = [&](int c, int r) {
    return c < exchanged_ ? here(c, r) + 50 * noise_at(r, c % kRows) : here(c, r);
  };
  const Store before = store_of("before", here, 0);
  test::expect_sound(before);
  expect_same_levels_far_away(before, store_of("exchanged", exchanged, 0));
  expect_same_levels_far_away(before, store_of("without", here, exchanged_));
}

/// Which levels are fine follows from the heights near by, too, whatever most of the terrain is like.
TEST_F(LocalLevels, BesideTerrainThatBecomesRough) {
  columns_ = 1300, exchanged_ = 620;
  const Terrain here = [](int c, int r) { return 40 * std::sin(c / 30.0) * std::cos(r / 40.0) + (c * 7 + r * 13) % 3; };
  const Terrain exchanged = [&](int c, int r) {
    return here(c, r) + (c < exchanged_ ? (c * 7919 + r * 104729) % 97 : 0);
  };
  expect_same_levels_far_away(store_of("before", here, 0), store_of("exchanged", exchanged, 0));
}

}  // namespace
}  // namespace itin
