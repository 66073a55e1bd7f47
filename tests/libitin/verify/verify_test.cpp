// Stores that say false things of their surfaces under checksums that fit: found, and named; true ones are left alone.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/parallel.hpp>
#include <itin/triangulate.hpp>
#include <itin/verify.hpp>

#include "support/forged_directory.hpp"
#include "support/impatient.hpp"
#include "support/overlay_samples.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/sound_store.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"
#include "verify/certificates.hpp"
#include "verify/height_difference.hpp"
#include "verify/leaf_cover.hpp"

namespace itin {
namespace {

using testing::AllOf;
using testing::Field;
using testing::HasSubstr;
using testing::StartsWith;

class Verify : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }

  void add(const std::string& file, std::optional<ThemeKind> kind = std::nullopt, ImportOptions options = {}) {
    options.sources = {path(file)};
    options.kind = kind;
    if (kind) {
      import_lines(store_, options, progress_);
    } else {
      import_terrain(store_, options, progress_);
    }
  }
  void add_terrain(double step, int columns, int rows, const std::function<double(int, int)>& height,
                   ImportOptions options = {}) {
    test::write_raster(path("t.tif"), {300000, 200000, step, columns, rows, 27700}, height);
    add("t.tif", std::nullopt, std::move(options));
  }
  void add_houses(const std::vector<test::LineFeature>& houses) {
    test::write_lines(path("houses.geojson"), houses, true);
    ImportOptions options;
    options.height_field = "h";
    options.theme = "houses";
    add("houses.geojson", ThemeKind::Buildings, options);
  }
  std::vector<Damage> damage(std::size_t sample = 0) {
    const Store store(store_);
    for (const Damage& d : check(store, progress_)) ADD_FAILURE() << d.place << ": " << d.what;
    return verify(store, {sample}, progress_).damage;
  }
  void expect_sound() { test::expect_sound(Store(store_)); }

  const test::TemporaryDirectory directory_;
  const std::string store_ = directory_.file("s.itin");
  const test::CardiffTerrain terrain_;
  NoProgress progress_;
};

/// Every certificate a step tighter at both ends: those that samples disprove are found, and what is found is no more
/// than what the import had certified.
TEST_F(Verify, FindsBoundsThatAreTooTightByOneStep) {
  const auto with_void = [&](int c, int r) {
    return std::hypot(c - 20, r - 25) < 6 ? std::nan("") : terrain_(c + 150, r + 250);
  };
  add_terrain(50, 66, 64, with_void);
  expect_sound();
  const Store store(store_);
  const StoreMetadata& metadata = store.metadata();
  const Grid& grid = metadata.grid;
  const Tin fine = triangulate(store, Window::all(), Detail::tolerance(0), progress_);
  std::size_t found_in_all = 0;
  for (std::size_t k = 1; k < metadata.levels.size(); ++k) {
    const Tin coarse = triangulate(store, Window::all(), Detail::tolerance(metadata.levels[k].tolerance), progress_);
    const std::vector<test::Sample> samples = test::overlay(fine, coarse);
    std::vector<Leaf> leaves;
    file_of(store).leaves_of(static_cast<int>(k), metadata.bounds, leaves);
    const std::string forged = path("forged.itin");
    std::filesystem::copy_file(store_, forged, std::filesystem::copy_options::overwrite_existing);
    test::forge_directory(forged, static_cast<int>(k), [](DirectoryChunk& chunk) {
      for (Leaf& leaf : chunk) leaf.lo = std::min(0, leaf.lo + 1), leaf.hi = std::max(0, leaf.hi - 1);
    });
    const Store tight(forged);
    const std::vector<FalseCell> found =
        false_certificates(file_of(tight), selections_of_levels(tight.metadata()), Cell{});
    found_in_all += found.size();
    for (const Leaf& leaf : leaves) {
      const auto of_leaf = std::find_if(found.begin(), found.end(),
                                        [&](const FalseCell& f) { return f.leaf && f.leaf->cell == leaf.cell; });
      const Box box = grid.box(leaf.cell.box());
      const auto disproves = [&](const test::Sample& s) {
        const double d = s.difference / grid.resolution;
        return box.contains(s.position) && (d < std::min(0, leaf.lo + 1) - 0.01 || d > std::max(0, leaf.hi - 1) + 0.01);
      };
      if (std::any_of(samples.begin(), samples.end(), disproves)) {
        EXPECT_NE(of_leaf, found.end()) << "level " << k << " " << box.xmin << " " << box.ymin;
      }
      if (of_leaf == found.end()) continue;
      EXPECT_EQ(of_leaf->tree, static_cast<int>(k));
      EXPECT_GE(of_leaf->differs.lo, leaf.lo - 1e-3);
      EXPECT_LE(of_leaf->differs.hi, leaf.hi + 1e-3);
    }
  }
  EXPECT_GT(found_in_all, metadata.levels.size() - 1);
}

TEST_F(Verify, FindsACertificateOfNothing) {
  add_terrain(50, 60, 60, [&](int c, int r) { return terrain_(c + 100, r + 200); });
  Leaf forged;
  test::forge_directory(store_, 3, [&](DirectoryChunk& chunk) {
    const auto widest = std::max_element(chunk.begin(), chunk.end(),
                                         [](const Leaf& a, const Leaf& b) { return a.hi - a.lo < b.hi - b.lo; });
    forged = *widest;
    widest->lo = widest->hi = 0;
  });
  const std::vector<Damage> found = damage();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].place, format::place("directory", forged.key));
  EXPECT_THAT(found[0].what, AllOf(StartsWith("the certificate of level 3 for the "), HasSubstr(" is 0 to 0 m, "),
                                   HasSubstr("must be at least ")));
}

TEST_F(Verify, FindsThatAllAreZero) {
  add_terrain(50, 80, 80, [&](int c, int r) { return terrain_(c + 60, r + 200); });
  const std::size_t levels = Store(store_).metadata().levels.size();
  for (std::size_t k = 1; k < levels; ++k)
    test::forge_directory(store_, static_cast<int>(k), [](DirectoryChunk& chunk) {
      for (Leaf& leaf : chunk) leaf.lo = leaf.hi = 0;
    });
  const std::vector<Damage> found = damage();
  std::set<std::string> named;
  for (const Damage& d : found) named.insert(d.what.substr(0, std::string("the certificate of level 3").size()));
  EXPECT_EQ(named.size(), levels - 1);
  // With any number of threads, in the same words.
  set_thread_count(1);
  const std::vector<Damage> alone = damage();
  set_thread_count(0);
  ASSERT_EQ(alone.size(), found.size());
  for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(alone[i].what, found[i].what);
}

/// A plane has few points at coarse levels, so most cells are leaves without any.
TEST_F(Verify, FindsGroundWithoutACertificate) {
  add_terrain(10, 200, 200, [](int c, int r) { return 0.1 * c + 0.2 * r + (c % 40 == 7 && r % 40 == 9 ? 3 : 0); });
  expect_sound();
  bool left_out = false;
  test::forge_directory(store_, 1, [&](DirectoryChunk& chunk) {
    const auto empty = std::find_if(chunk.begin(), chunk.end(), [](const Leaf& leaf) { return leaf.points == 0; });
    if (left_out || empty == chunk.end()) return;
    chunk.erase(empty);
    left_out = true;
  });
  if (!left_out) GTEST_SKIP() << "every leaf has points";
  EXPECT_THAT(damage(), testing::ElementsAre(
                            AllOf(Field(&Damage::place, "level 1"),
                                  Field(&Damage::what, StartsWith("there is ground without a certificate at ")))));
}

TEST_F(Verify, FindsHeightsOfFeaturesThatAreTooLow) {
  add_terrain(10, 80, 80, [](int c, int r) { return 50 + 8 * std::sin(c * 0.2) + 5 * std::cos(r * 0.13); });
  // A block, a shed apart, which is left out sooner, and a gable.
  add_houses({test::box(300102, 199702, 300142, 199732, 9), test::box(300142, 199702, 300172, 199732, 14),
              test::box(300402, 199402, 300406, 199405, 3)});
  expect_sound();
  const Store store(store_);
  const StoreMetadata& metadata = store.metadata();
  ASSERT_GE(metadata.parts.size(), 2u);
  for (std::size_t p = 0; p < metadata.parts.size(); ++p) {
    const std::string forged = path("forged.itin");
    std::filesystem::copy_file(store_, forged, std::filesystem::copy_options::overwrite_existing);
    const int tree = format::vertex_tree(static_cast<int>(metadata.themes.size() + p + 1));
    test::forge_directory(forged, tree, [](DirectoryChunk& chunk) {
      for (Leaf& leaf : chunk) leaf.hi = 0;
    });
    const std::vector<Damage> found = verify(Store(forged), {}, progress_).damage;
    ASSERT_FALSE(found.empty()) << "part " << p;
    EXPECT_THAT(found[0].place, StartsWith("directory "));
    EXPECT_THAT(found[0].what, StartsWith("theme 'houses' rises "));
    EXPECT_THAT(found[0].what, HasSubstr(", where the index says at most 0.00 m"));
  }
}

TEST_F(Verify, FindsHeightsOfFeaturesAMetreTooLowOnFlatGround) {
  add_terrain(10, 80, 80, [](int, int) { return 12.0; });
  add_houses({test::box(300102, 199702, 300142, 199732, 9)});
  expect_sound();
  const int tree = format::vertex_tree(2);
  test::forge_directory(store_, tree, [](DirectoryChunk& chunk) {
    for (Leaf& leaf : chunk) leaf.hi = std::max(0, leaf.hi - 100);
  });
  const std::vector<Damage> found = damage();
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(found[0].what,
              AllOf(StartsWith("theme 'houses' rises 9.00 m above the ground at 3001"), HasSubstr("at most 8.00 m")));
}

/// The metadata's own bounds are compared with the cells' as well.
TEST_F(Verify, ASampleIsPartOfTheWhole) {
  add_terrain(10, 500, 500, [](int c, int r) { return 30 * std::sin(c * 0.11) * std::cos(r * 0.07) + c % 7; });
  const Store store(store_);
  const Verification all = verify(store, {}, progress_), some = verify(store, {3}, progress_);
  EXPECT_TRUE(all.damage.empty());
  EXPECT_TRUE(some.damage.empty());
  EXPECT_EQ(all.tiles, all.tiles_verified);
  EXPECT_EQ(some.tiles, all.tiles);
  EXPECT_GT(all.tiles, 3u);
  EXPECT_EQ(some.tiles_verified, 3u);
}

TEST_F(Verify, CanBeCancelled) {
  add_terrain(50, 40, 40, terrain_);
  test::Impatient progress(0);
  EXPECT_THROW(verify(Store(store_), {}, progress), Cancelled);
}

// Certificates that an import writes are true for every kind of source.

TEST_F(Verify, SoundWithASingleCoarseLevel) {
  ImportOptions options;
  options.tolerances = {100};
  add_terrain(50, 60, 60, terrain_, options);
  expect_sound();
}

TEST_F(Verify, SoundAtSteepPlacesAndOddSteps) {
  ImportOptions options;
  options.tolerances = {0.011, 0.019, 0.5, 40};
  add_terrain(
      3.7, 90, 90, [](int c, int r) { return (c * 7919 + r * 104729) % 97 * 4.1 - (c > 40 ? 800 : 0); }, options);
  expect_sound();
}

TEST_F(Verify, SoundWithReplacedGround) {
  add_terrain(50, 60, 60, [&](int c, int r) { return terrain_(c + 100, r + 200); });
  test::write_raster(path("fine.tif"), {300700, 199300, 10, 90, 70, 27700},
                     [&](int c, int r) { return terrain_(c / 5 + 114, r / 5 + 214) + 2 * std::sin(c * 0.3); });
  ImportOptions options;
  options.replace = true;
  add("fine.tif", std::nullopt, options);
  expect_sound();
}

TEST_F(Verify, SoundWithScatteredPoints) {
  std::mt19937 random(test::seed());
  std::ofstream csv(path("p.csv"));
  csv << "x,y,z\n";
  std::uniform_real_distribution<double> along(0, 1000);
  for (int i = 0; i < 6000; ++i) {
    const double x = along(random), y = along(random);
    if (std::hypot(x - 300, y - 600) < 90) continue;
    csv << 300000 + x << "," << 200000 + y << "," << 20 * std::sin(x / 70) + y / 30 + along(random) / 500 << "\n";
  }
  csv.close();
  ImportOptions options;
  options.crs = "EPSG:27700";
  add("p.csv", std::nullopt, options);
  expect_sound();
}

TEST_F(Verify, SoundWithContoursAndHousesOnThem) {
  std::vector<test::LineFeature> rings;
  for (int h = 0; h < 8; ++h) {
    test::LineFeature ring;
    for (int i = 0; i <= 60; ++i) {
      const double a = 6.283185307 * (i % 60) / 60, r = 500 - 55 * h + 15 * std::sin(3 * a + h);
      ring.vertices.push_back({300500 + r * std::cos(a), 199500 + r * std::sin(a), 10.0 * h});
    }
    rings.push_back(ring);
  }
  test::write_lines(path("contours.geojson"), rings);
  ImportOptions options;
  options.theme = "contours";
  add("contours.geojson", ThemeKind::Contours, options);
  expect_sound();
  std::vector<test::LineFeature> houses;
  for (int i = 0; i < 10; ++i)
    houses.push_back(test::box(300300 + 37 * i, 199350 + 21 * i, 300318 + 37 * i, 199361 + 21 * i, 4 + i));
  add_houses(houses);
  expect_sound();
}

// The pieces.

TEST(LeafCover, TellsWhereATriangleLies) {
  const auto leaf = [](std::int32_t x, std::int32_t y) {
    Leaf l;
    l.cell = Cell{morton(x, y), 4};
    return l;
  };
  const LeafCover cover({leaf(0, 0), leaf(16, 0), leaf(0, 16)});
  const auto visited = [&](const Corners& triangle, bool& gap) {
    std::vector<std::size_t> leaves;
    gap = false;
    cover.visit(
        triangle, [&](std::size_t i) { leaves.push_back(i); }, [&](const Cell&) { gap = true; });
    return leaves;
  };
  bool gap = false;
  EXPECT_THAT(visited({{{0, 0}, {15, 0}, {0, 15}}}, gap), testing::ElementsAre(0));
  EXPECT_FALSE(gap);
  // On the border, but not beyond it.
  EXPECT_THAT(visited({{{0, 0}, {16, 0}, {0, 16}}}, gap), testing::ElementsAre(0));
  EXPECT_FALSE(gap);
  // Its box meets the empty cell, but the triangle only touches that.
  EXPECT_THAT(visited({{{0, 0}, {32, 0}, {0, 32}}}, gap), testing::ElementsAre(0, 1, 2));
  EXPECT_FALSE(gap);
  EXPECT_THAT(visited({{{0, 0}, {33, 0}, {0, 32}}}, gap), testing::ElementsAre(0, 1, 2));
  EXPECT_TRUE(gap);
}

}  // namespace
}  // namespace itin
