// Which features rings have: block by block as the terrain, wherever a window lies and in whatever order themes came.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include <itin/feature_at.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "features/mesh/terrain_heights.hpp"
#include "support/alexandria.hpp"
#include "support/corner_triangles.hpp"
#include "support/houses.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/sound_store.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"
#include "triangulate/chosen_clusters.hpp"

namespace itin {
namespace {

using test::box;
using test::LineFeature;
using test::triangles_of;

/// A rectangle on the ground, and how high it stands.
struct House {
  Box plan;
  double height = 0;
};

class RingFeatures : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }
  double in(double low, double high) { return low + (high - low) * static_cast<double>(random_() % 100001) / 100000; }

  /// 600 m of ground from (300000, 199400).
  template <class Height>
  void ground(const std::string& store, const Height& height) const {
    test::write_raster(path("t.tif"), {300000, 200000, 10, 60, 60, 27700}, height);
    ImportOptions options;
    options.sources = {path("t.tif")};
    NoProgress progress;
    import_terrain(path(store), options, progress);
  }

  void raise(const std::string& store, ThemeKind kind, const std::string& theme,
             const std::vector<House>& houses) const {
    std::vector<LineFeature> features;
    for (const auto& [plan, height] : houses)
      features.push_back(box(plan.xmin, plan.ymin, plan.xmax, plan.ymax, height));
    test::import_raised(path(store), path(theme + ".geojson"), kind, theme, features);
  }

  /// Whole metres, so that many touch.
  std::vector<House> town(int count, double least, double most) {
    std::vector<House> houses;
    for (int i = 0; i < count; ++i) {
      const double x = 300020 + std::floor(in(0, 510)), y = 199420 + std::floor(in(0, 510));
      houses.push_back({{x, y, x + std::floor(in(least, most)), y + std::floor(in(least, most))}, in(4, 12)});
      const Box& first = houses.back().plan;
      if (i % 3 == 0) houses.push_back({{first.xmax, first.ymin, first.xmax + 6, first.ymin + 5}, in(4, 12)});
    }
    return houses;
  }

  Detail rings() {
    const Point2 eye{in(300000, 300600), in(199400, 200000)};
    const double radius = in(10, 150);
    return Detail::rings(eye, {{radius, 0}, {radius * 1.4, 2}, {radius * 2, 8}, {radius * 3, in(16, 64)}});
  }

  static Tin surface(const Store& store, const Detail& detail, const ThemeChoice& themes = ThemeChoice::all()) {
    NoProgress progress;
    return triangulate(store, Window::all(), detail, progress, themes);
  }

  static double height(const TerrainHeights& heights, const Grid& grid, Point2 p) {
    const GridPoint at = grid.quantise({p.x, p.y, 0});
    return heights.height_at({at.x, at.y}).value_or(std::nan(""));
  }

  std::mt19937 random_{test::seed()};
  test::TemporaryDirectory directory_;
};

/// For each house the number of the first one of its cluster: those that touch, and what touches these.
std::vector<std::size_t> clusters_of(const std::vector<House>& houses) {
  std::vector<std::size_t> first(houses.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < houses.size(); ++i)
      for (std::size_t j = 0; j < houses.size(); ++j)
        if (first[j] < first[i] && houses[i].plan.meets(houses[j].plan)) first[i] = first[j], changed = true;
  }
  return first;
}

/// Whether FORMAT.md's rule has features whose cluster has this box; neither where rounding decides.
std::optional<bool> has(const StoreMetadata& metadata, const Detail& detail, const Box& cluster) {
  const auto level_of = [&](double limit, double LevelInfo::*tolerance) {
    std::size_t level = 0;
    while (level + 1 < metadata.levels.size() && metadata.levels[level + 1].*tolerance <= limit) ++level;
    return level;
  };
  const std::size_t coarsest = level_of(std::max(cluster.width(), cluster.height()), &LevelInfo::lateral_tolerance);
  const auto asked_for = [&](double margin) {
    const Point2 c = detail.centre();
    const double x = std::max({cluster.xmin - margin - c.x, 0.0, c.x - cluster.xmax - margin}),
                 y = std::max({cluster.ymin - margin - c.y, 0.0, c.y - cluster.ymax - margin});
    for (std::size_t i = 0; i + 1 < detail.rings().size(); ++i)
      if (std::hypot(x, y) <= detail.rings()[i].radius)
        return level_of(detail.rings()[i].tolerance, &LevelInfo::tolerance);
    return level_of(detail.coarsest(), &LevelInfo::tolerance);
  };
  // Boxes are stored in steps of 64 grid units.
  const bool least = asked_for(-0.02) <= coarsest, most = asked_for(0.66) <= coarsest;
  return least == most ? std::optional(most) : std::nullopt;
}

TEST_F(RingFeatures, HaveEachHouseAsItsFootprintsSay) {
  ground("s.itin", [](int, int) { return 50.0; });
  const std::vector<House> houses = town(120, 2, 30);
  raise("s.itin", ThemeKind::Buildings, "houses", houses);
  const Store store(path("s.itin"));
  test::expect_sound(store);
  const std::vector<std::size_t> first = clusters_of(houses);
  std::vector<Box> boxes(houses.size());
  for (std::size_t i = 0; i < houses.size(); ++i) {
    boxes[first[i]].extend(Point2{houses[i].plan.xmin, houses[i].plan.ymin});
    boxes[first[i]].extend(Point2{houses[i].plan.xmax, houses[i].plan.ymax});
  }
  int present = 0, missing = 0;
  for (int round = 0; round < 12; ++round) {
    const Detail detail = rings();
    const Tin tin = surface(store, detail);
    const TerrainHeights heights(tin);
    for (std::size_t i = 0; i < houses.size(); ++i) {
      const std::optional<bool> expected = has(store.metadata(), detail, boxes[first[i]]);
      if (!expected) continue;
      const Box& plan = houses[i].plan;
      const double z = height(heights, tin.grid, {(plan.xmin + plan.xmax) / 2, (plan.ymin + plan.ymax) / 2});
      // Where it is not, the ground is bare.
      EXPECT_TRUE(*expected ? z > 53.9 : z == 50) << plan.xmin << ' ' << plan.ymin << ": " << z;
      ++(*expected ? present : missing);
    }
  }
  EXPECT_GT(present, 100);
  EXPECT_GT(missing, 100);
}

TEST_F(RingFeatures, DropAHouseWhereNoneOfThemAsksForIt) {
  ground("s.itin", [](int, int) { return 50.0; });
  // Houses of 5 m, one of them beside the centre of the rings, and a pair that stands wall to wall.
  raise("s.itin", ThemeKind::Buildings, "houses",
        {{{300052, 199452, 300057, 199457}, 9},
         {{300502, 199902, 300507, 199907}, 8},
         {{300552, 199452, 300557, 199457}, 7},
         {{300557, 199452, 300562, 199457}, 6}});
  const Store store(path("s.itin"));
  const Point2 centre{300060, 199460};
  const auto above = [&](const Detail& detail) {
    const Tin tin = surface(store, detail);
    const TerrainHeights heights(tin);
    const auto at = [&](double x, double y) { return std::round(height(heights, tin.grid, {x, y})) - 50; };
    return std::array{at(300054, 199454), at(300504, 199904), at(300554, 199454), at(300559, 199454)};
  };
  EXPECT_EQ(above(Detail::rings(centre, {{100, 0}, {200, 16}})), (std::array{9.0, 0.0, 0.0, 0.0}));
  // The rim passes between the two houses, of which half a cluster must not be there.
  EXPECT_EQ(above(Detail::rings(centre, {{495, 0}, {600, 16}})), (std::array{9.0, 0.0, 7.0, 6.0}));
  EXPECT_EQ(above(Detail::rings(centre, {{900, 0}, {1000, 16}})), (std::array{9.0, 8.0, 7.0, 6.0}));
}

TEST_F(RingFeatures, OfOneToleranceAreThatTolerance) {
  ground("s.itin", [](int c, int r) { return 100 + 8 * std::sin(c * 0.3) + 6 * std::cos(r * 0.23); });
  raise("s.itin", ThemeKind::Buildings, "houses", town(60, 2, 20));
  raise("s.itin", ThemeKind::Vegetation, "woods", town(8, 20, 90));
  const Store store(path("s.itin"));
  for (const double tolerance : {0.0, 2.0, 16.0}) {
    const Tin plain = surface(store, Detail::tolerance(tolerance));
    const Tin ringed = surface(store, Detail::rings({300300, 199700}, {{100, tolerance}, {200, tolerance}}));
    EXPECT_EQ(ringed.vertices, plain.vertices);
    EXPECT_EQ(ringed.triangles, plain.triangles);
    EXPECT_EQ(ringed.raised_theme, plain.raised_theme);
    EXPECT_EQ(ringed.lines, plain.lines);
  }
}

TEST_F(RingFeatures, AreTheSameInWhateverOrderThemesCame) {
  const auto rolling = [](int c, int r) { return 100 + 8 * std::sin(c * 0.3) + 6 * std::cos(r * 0.23); };
  const std::vector<House> houses = town(60, 2, 20), woods = town(8, 20, 90), sheds = town(30, 1, 5);
  ground("a.itin", rolling);
  raise("a.itin", ThemeKind::Buildings, "houses", houses);
  raise("a.itin", ThemeKind::Vegetation, "woods", woods);
  raise("a.itin", ThemeKind::Walls, "sheds", sheds);
  ground("b.itin", rolling);
  raise("b.itin", ThemeKind::Walls, "sheds", sheds);
  raise("b.itin", ThemeKind::Vegetation, "woods", woods);
  raise("b.itin", ThemeKind::Buildings, "houses", houses);
  const Store a(path("a.itin")), b(path("b.itin"));
  for (int round = 0; round < 4; ++round) {
    const Detail detail = rings();
    EXPECT_EQ(triangles_of(surface(a, detail)), triangles_of(surface(b, detail)));
  }
}

/// Trees and houses cross edges of triangles 50 m long: the ground about each makes way for the others where they are.
TEST_F(RingFeatures, AreOnCoarseGroundWhatTheirFootprintsSay) {
  test::write_raster(path("t.tif"), {299950, 200050, 50, 15, 15, 27700},
                     [](int c, int r) { return 50.0 + (c * 7 + r * 13) % 5; });
  ImportOptions options;
  options.sources = {path("t.tif")};
  NoProgress progress;
  import_terrain(path("s.itin"), options, progress);
  raise("s.itin", ThemeKind::Buildings, "houses", town(80, 4, 12));
  raise("s.itin", ThemeKind::Vegetation, "trees", town(150, 2, 5));
  const Store store(path("s.itin"));
  test::expect_sound(store);
  for (int round = 0; round < 4; ++round) {
    const Detail detail = rings();
    const auto whole = triangles_of(surface(store, detail));
    for (int i = 0; i < 8; ++i) {
      const double x = in(300030, 300500), y = in(199430, 199900), side = in(5, 60);
      const auto part = triangles_of(
          triangulate(store, Window::box({x, y, x + side, y + side}), detail, progress, ThemeChoice::all()));
      EXPECT_TRUE(std::includes(whole.begin(), whole.end(), part.begin(), part.end()));
    }
  }
}

/// The numbers of the buildings that triangles are part of, and where these triangles are.
std::map<std::int64_t, std::vector<Point2>> buildings_in(const Store& store, const Tin& tin) {
  std::vector<Point2> middles;
  for (const Triangle& t : tin.triangles) {
    const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
    if (tin.theme(t) != 0) middles.push_back({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3});
  }
  std::map<std::int64_t, std::vector<Point2>> found;
  const auto features = features_at(store, 1, middles);
  for (std::size_t i = 0; i < middles.size(); ++i)
    if (features[i]) found[features[i]->number].push_back(middles[i]);
  return found;
}

TEST_F(RingFeatures, OfAlexandriaAreThoseOfEachRingsTolerance) {
  NoProgress progress;
  test::import_alexandria(path("s.itin"));
  const Store store(path("s.itin"));
  test::expect_sound(store);
  const auto all = buildings_in(store, surface(store, Detail::tolerance(0)));
  const auto largest = buildings_in(store, surface(store, Detail::tolerance(32)));
  ASSERT_GT(all.size(), largest.size() + 20);
  for (const double radius : {30.0, 80.0, 150.0}) {
    const Point2 eye{321500 + in(150, 400), 4297500 + in(150, 400)};
    const Detail detail = Detail::rings(eye, {{radius, 0}, {1.5 * radius, 32}});
    const Tin tin = surface(store, detail);
    const auto found = buildings_in(store, tin);
    for (const auto& [number, places] : all) {
      const bool near = std::any_of(places.begin(), places.end(),
                                    [&](Point2 p) { return std::hypot(p.x - eye.x, p.y - eye.y) < radius; });
      EXPECT_TRUE(found.contains(number) || (!near && !largest.contains(number))) << number;
    }
    EXPECT_LT(found.size(), all.size());
    const auto whole = triangles_of(tin);
    for (int i = 0; i < 6; ++i) {
      const double x = eye.x + in(-1, 1) * radius, y = eye.y + in(-1, 1) * radius;
      const auto part =
          triangles_of(triangulate(store, Window::disc({x, y}, 20), detail, progress, ThemeChoice::all()));
      EXPECT_TRUE(std::includes(whole.begin(), whole.end(), part.begin(), part.end()));
    }
  }
}

/// Threads that are the first to ask for a leaf, at the same time, have what one alone has.
TEST_F(RingFeatures, SegmentsAreThoseOfOneThreadForManyAtOnce) {
  test::import_alexandria(path("s.itin"));
  const Store store(path("s.itin"));
  const Selection selection =
      selection_of(store.metadata(), Detail::rings({321700, 4297700}, {{150, 0}, {225, 32}}), ThemeChoice::all());
  const GridBox all = store.points().bounds();
  const auto segments = [&](const ChosenClusters& chosen) {
    std::vector<Segment> found;
    for (std::size_t part = 0; part < store.metadata().parts.size(); ++part)
      chosen.segments(static_cast<std::uint16_t>(store.metadata().themes.size() + part + 1), all, found);
    return found;
  };
  const std::vector<Segment> expected = segments(ChosenClusters(store, selection));
  ASSERT_GT(expected.size(), 1000U);
  for (int round = 0; round < 40; ++round) {
    const ChosenClusters chosen(store, selection);
    std::array<std::vector<Segment>, 4> found;
    std::vector<std::thread> threads;
    for (auto& f : found) threads.emplace_back([&] { f = segments(chosen); });
    for (std::thread& t : threads) t.join();
    for (const auto& f : found) ASSERT_EQ(f, expected);
  }
}

}  // namespace
}  // namespace itin
