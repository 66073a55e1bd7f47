// Buildings, vegetation and walls in stores: law 1 with them against a global triangulation, and what they look like.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iostream>
#include <map>
#include <optional>
#include <random>
#include <set>

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "features/mesh/terrain_heights.hpp"
#include "libitin/features/surface_comparison.hpp"
#include "store/codec/point_index.hpp"
#include "store/codec/store_format.hpp"
#include "store/segments/clusters.hpp"
#include "store/store_file.hpp"
#include "support/corner_triangles.hpp"
#include "support/raster_file.hpp"
#include "support/rolling_ground.hpp"
#include "support/seed.hpp"
#include "support/sound_store.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"
#include "triangulate/apex/selection.hpp"
#include "triangulate/mesh/delaunay.hpp"

namespace itin {
namespace {

using test::box;
using test::LineFeature;
using test::smallest_first;
using test::TriangleCorners;
using test::triangles_of;

/// The level of the first ring that meets the box. Centre and radii are rounded to the grid.
int finest_asked_for(const StoreMetadata& metadata, const GridBox& box, const Detail& detail) {
  const Grid& grid = metadata.grid;
  const auto units = [&](double metres) { return std::llround(metres / grid.resolution); };
  double tolerance = detail.coarsest();
  if (detail.rings().size() > 1) {
    const std::int64_t x = units(detail.centre().x - grid.origin.x), y = units(detail.centre().y - grid.origin.y);
    const std::int64_t dx = std::max<std::int64_t>({box.xmin - x, 0, x - box.xmax}),
                       dy = std::max<std::int64_t>({box.ymin - y, 0, y - box.ymax});
    for (std::size_t i = detail.rings().size() - 1; i-- > 0;) {
      const std::int64_t radius = units(detail.rings()[i].radius);
      if (dx * dx + dy * dy <= radius * radius) tolerance = detail.rings()[i].tolerance;
    }
  }
  int level = 0;
  for (std::size_t k = 1; k < metadata.levels.size(); ++k)
    if (metadata.levels[k].tolerance <= tolerance) level = static_cast<int>(k);
  return level;
}

/// The global triangulation of what FORMAT.md says is there, ground or not: read leaf by leaf, without the code under
/// test.
std::set<TriangleCorners> global(const Store& store, const Detail& detail, const ThemeChoice& choice) {
  const StoreMetadata& metadata = store.metadata();
  const std::size_t themes = metadata.themes.size();
  std::vector<double> tolerances;
  for (const LevelInfo& level : metadata.levels) tolerances.push_back(level.tolerance);
  const Selection selection(detail, tolerances, metadata.grid);
  // The theme that a number stands for: of a part or of lines on the ground.
  const auto theme_of = [&](std::uint16_t number) -> const ThemeInfo& {
    return number > themes ? metadata.themes[metadata.parts[number - themes - 1].theme - 1u]
                           : metadata.themes[number - 1u];
  };
  const auto there = [&](std::uint16_t number) {
    if (number == 0) return true;
    if (!choice.includes(theme_of(number))) return false;
    return number <= themes || metadata.parts[number - themes - 1].coarsest >= selection.finest();
  };
  // By item of a leaf: whether it is of a cluster that is there.
  const auto items_there = [&](std::uint16_t number, const Leaf& leaf, const std::vector<GridBox>& extents) {
    const bool clustered = number > themes && metadata.parts[number - themes - 1].has_clusters;
    std::vector<bool> found(extents.size(), there(number) && !clustered);
    if (!there(number) || !clustered) return found;
    const LeafClusters clusters = file_of(store).read_clusters(leaf, extents);
    for (const auto& [item, cluster] : clusters.items)
      if (finest_asked_for(metadata, clusters.boxes[cluster], detail) <= metadata.parts[number - themes - 1].coarsest)
        found[item] = true;
    return found;
  };
  const auto gives_way = [&](std::uint16_t number, std::uint16_t part) {
    if (number <= themes) return true;
    const ThemeInfo &a = theme_of(part), &b = theme_of(number);
    return a.name != b.name && comes_before(a, b);
  };
  std::vector<Leaf> leaves;
  store.points().leaves({}, store.points().bounds(), leaves);
  std::map<Position, std::set<std::uint16_t>> masks;
  for (const Leaf& leaf : leaves) {
    if (leaf.theme <= themes || !there(leaf.theme)) continue;
    const auto block = store.points().block(leaf);
    const std::vector<bool> present = items_there(leaf.theme, leaf, extents_of(block->points));
    for (std::size_t k = 0; k < block->points.size(); ++k)
      if (present[k]) masks[{block->points[k].x, block->points[k].y}].insert(leaf.theme);
  }
  std::map<Position, GridPoint> points;
  for (const Leaf& leaf : leaves) {
    if (!there(leaf.theme)) continue;
    const auto block = store.points().block(leaf);
    const std::vector<bool> present = items_there(leaf.theme, leaf, extents_of(block->points));
    for (std::size_t k = 0; k < block->points.size(); ++k) {
      const GridPoint& p = block->points[k];
      if (!present[k]) continue;
      if (leaf.theme > themes && block->sources[k] == format::kMask) continue;
      if (leaf.theme == 0 && !selection.selects(level_of(leaf, *block, k), p.x, p.y)) continue;
      const auto mask = masks.find({p.x, p.y});
      if (mask != masks.end() && std::any_of(mask->second.begin(), mask->second.end(), [&](std::uint16_t part) {
            return part != leaf.theme && gives_way(leaf.theme, part);
          }))
        continue;
      const auto [at, fresh] = points.emplace(Position{p.x, p.y}, p);
      EXPECT_TRUE(fresh || at->second == p) << "two heights at one place";
    }
  }
  std::vector<Segment> segments;
  for (std::size_t number = 0; number <= themes + metadata.parts.size(); ++number) {
    const auto theme = static_cast<std::uint16_t>(number);
    std::vector<Leaf> edges;
    file_of(store).leaves_of(format::edge_tree(theme), store.points().bounds(), edges);
    for (const Leaf& leaf : edges) {
      const std::vector<Segment> own = file_of(store).read_edges(leaf);
      const std::vector<bool> present = items_there(theme, leaf, extents_of(own));
      for (std::size_t i = 0; i < own.size(); ++i)
        if (present[i]) segments.push_back(own[i]);
    }
  }
  std::set<std::array<std::int32_t, 5>> gone;
  for (const Segment& s : segments)
    if (s.finest == 255) gone.insert({s.ax, s.ay, s.bx, s.by, s.reach});
  std::vector<Position> positions;
  std::vector<GridPoint> corners;
  std::map<Position, std::uint32_t> number;
  for (const auto& [position, p] : points) {
    number.emplace(position, static_cast<std::uint32_t>(positions.size()));
    positions.push_back(position);
    corners.push_back(p);
  }
  Delaunay delaunay;
  delaunay.insert(positions);
  std::vector<Delaunay::Constraint> constraints;
  for (const Segment& s : std::set<Segment>(segments.begin(), segments.end())) {
    if (s.finest == 255 || !selection.selects(s)) continue;
    if (gone.contains({s.ax, s.ay, s.bx, s.by, s.theme})) continue;
    const auto a = number.find({s.ax, s.ay}), b = number.find({s.bx, s.by});
    if (a == number.end() || b == number.end()) {
      ADD_FAILURE() << "a segment of theme " << s.theme << " ends nowhere";
      continue;
    }
    constraints.emplace_back(a->second, b->second);
  }
  delaunay.constrain(constraints);
  std::set<TriangleCorners> result;
  for (const auto& t : delaunay.mesh().triangles)
    result.insert(smallest_first({corners[t[0]], corners[t[1]], corners[t[2]]}));
  return result;
}

class RaisedFeatures : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }

  /// 60 x 60 posts every `step` metres from (300000, 200000 - 60 step).
  template <class Height>
  void ground(double step, const Height& height) const {
    test::write_raster(path("t.tif"), {300000, 200000, step, 60, 60, 27700}, height);
    ImportOptions options;
    options.sources = {path("t.tif")};
    NoProgress progress;
    import_terrain(path("s.itin"), options, progress);
  }

  ImportReport add(ThemeKind kind, const std::string& theme, const std::vector<LineFeature>& features,
                   ImportOptions options = {}) const {
    test::write_lines(path(theme + ".geojson"), features, !is_terrain(kind));
    options.sources = {path(theme + ".geojson")};
    options.kind = kind;
    options.theme = theme;
    NoProgress progress;
    return import_lines(path("s.itin"), options, progress);
  }
  ImportReport raise(ThemeKind kind, const std::string& theme, const std::vector<LineFeature>& features,
                     ImportOptions options = {}) const {
    options.height_field = std::string(1, 'h');
    return add(kind, theme, features, options);
  }

  Tin whole(const ThemeChoice& choice, double tolerance = 0) const {
    NoProgress progress;
    return triangulate(Store(path("s.itin")), Window::all(), Detail::tolerance(tolerance), progress, choice);
  }

  static double height(const Tin& tin, double x, double y) {
    const TerrainHeights heights(tin);
    const GridPoint p = tin.grid.quantise({x, y, 0});
    const auto z = heights.height_at({p.x, p.y});
    return z ? *z : std::nan("");
  }

  void expect_sound() const { test::expect_sound(Store(path("s.itin"))); }

  static void expect_only_raised(const Tin& bare, const Tin& tin) {
    std::mt19937 random(test::seed());
    test::SurfaceComparison comparison(bare, tin);
    comparison.everywhere(random);
    comparison.expect_only_raised();
    comparison.expect_ground_kept();
  }

  test::TemporaryDirectory directory_;
};

void expect_windows_of_the_whole(const Store& store, std::mt19937& random, const std::vector<ThemeChoice>& choices) {
  NoProgress progress;
  const StoreMetadata& metadata = store.metadata();
  const Box bounds = metadata.grid.box(metadata.bounds);
  const Point2 centre{(bounds.xmin + bounds.xmax) / 2, (bounds.ymin + bounds.ymax) / 2};
  std::vector<Detail> details{Detail::tolerance(0), Detail::tolerance(2), Detail::tolerance(32)};
  details.push_back(Detail::rings(centre, {{bounds.width() / 8, 0}, {bounds.width() / 4, 2}, {bounds.width(), 32}}));
  for (int i = 0; i < 3; ++i) {
    const auto share = [&] { return static_cast<double>(random() % 1000) / 1000; };
    const Point2 eye{bounds.xmin + bounds.width() * share(), bounds.ymin + bounds.height() * share()};
    const double radius = 5 + bounds.width() * share() / 3;
    details.push_back(Detail::rings(eye, {{radius, 0}, {radius * 1.5, 4}, {radius * 2, 16}, {radius * 4, 64}}));
  }
  for (const ThemeChoice& choice : choices) {
    for (std::size_t k = 0; k < details.size(); ++k) {
      SCOPED_TRACE("detail " + std::to_string(k));
      const std::set<TriangleCorners> truth = global(store, details[k], choice);
      const std::set<TriangleCorners> found =
          triangles_of(triangulate(store, Window::all(), details[k], progress, choice));
      ASSERT_FALSE(found.empty());
      ASSERT_TRUE(std::includes(truth.begin(), truth.end(), found.begin(), found.end()));
      for (int i = 0; i < 12; ++i) {
        const auto in = [&](double low, double high) {
          return low + (high - low) * static_cast<double>(random() % 1000) / 1000;
        };
        const double side = i % 3 == 0 ? in(1, 5) : in(5, 200);
        const double x = in(bounds.xmin, bounds.xmax - side), y = in(bounds.ymin, bounds.ymax - side);
        const std::set<TriangleCorners> part =
            triangles_of(triangulate(store, Window::box({x, y, x + side, y + side}), details[k], progress, choice));
        ASSERT_TRUE(std::includes(found.begin(), found.end(), part.begin(), part.end()));
        const GridBox window = metadata.grid.enclosing({x, y, x + side, y + side});
        for (const TriangleCorners& c : found) {
          const bool within = std::all_of(c.begin(), c.end(), [&](const GridPoint& p) {
            return p.x > window.xmin && p.x < window.xmax && p.y > window.ymin && p.y < window.ymax;
          });
          ASSERT_TRUE(!within || part.contains(c));
        }
      }
    }
  }
}

TEST_F(RaisedFeatures, WindowEqualsWholeWithAllThatStands) {
  std::mt19937 random(test::seed());
  const auto in = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 100000) / 100000;
  };
  ground(10, test::rolling);
  std::vector<LineFeature> houses, woods, rows, walls, roads, ridges;
  for (int i = 0; i < 25; ++i) {  // they touch, overlap and leave the data
    const double x = 300000 + std::round(in(-5, 58)) * 10, y = 199400 + std::round(in(-5, 58)) * 10;
    houses.push_back(box(x, y, x + in(2, 40), y + in(2, 40), in(2, 30)));
    houses.push_back(box(x + in(-9, 9), y - 12, x + 12, y, in(2, 30)));
  }
  for (int i = 0; i < 6; ++i) {
    const double x = in(300020, 300400), y = in(199420, 199800);
    woods.push_back(box(x, y, x + in(20, 150), y + in(20, 150), in(5, 20)));
  }
  const auto line = [&](const char* properties) {
    LineFeature f;
    f.properties = properties;
    Point3 p{in(300020, 300570), in(199420, 199980), 0};
    for (int k = 0; k < 5; ++k) {
      f.vertices.push_back({p.x, p.y, 110 + in(-9, 9)});
      p = {p.x + in(-90, 90), p.y + in(-90, 90), 0};
    }
    return f;
  };
  for (int i = 0; i < 5; ++i) {
    walls.push_back(line(R"({"h":1.8})"));
    roads.push_back(line("{}"));
    ridges.push_back(line("{}"));
  }
  for (int i = 0; i < 6; ++i) {
    const double x = in(300020, 300400), y = in(199420, 199900);
    rows.push_back(box(x, y, x + in(40, 150), y + in(6, 12), in(4, 12)));
  }
  add(ThemeKind::Roads, "roads", roads);
  raise(ThemeKind::Vegetation, "woods", woods);
  const ImportReport report = raise(ThemeKind::Buildings, "houses", houses);
  EXPECT_GT(report.features, 20u);
  raise(ThemeKind::Walls, "walls", walls);
  raise(ThemeKind::Terraces, "rows", rows);
  add(ThemeKind::Breaklines, "ridges", ridges);  // the ground changes under all of them
  expect_sound();
  const Store store(path("s.itin"));
  EXPECT_EQ(store.metadata().themes.size(), 6u);
  expect_windows_of_the_whole(
      store, random,
      {ThemeChoice::none(), ThemeChoice::all(), ThemeChoice::all().with_ground_lines(), ThemeChoice::parse("houses"),
       ThemeChoice::parse("woods,rows"), ThemeChoice::parse("roads,walls").with_ground_lines()});
}

TEST_F(RaisedFeatures, AHouseHasItsHeightAndTheGroundItsOwn) {
  ground(10, [](int, int) { return 50.0; });
  const std::set<TriangleCorners> bare = triangles_of(whole(ThemeChoice::none()));
  // 40 m by 30 m about posts, which must not poke into the roof.
  const ImportReport report = raise(ThemeKind::Buildings, "houses", {box(300102, 199702, 300142, 199732, 9)});
  EXPECT_EQ(report.features, 1u);
  expect_sound();
  EXPECT_EQ(triangles_of(whole(ThemeChoice::none())), bare);
  const Tin tin = whole(ThemeChoice::all());
  for (double x = 300102.1; x < 300142; x += 3.9)
    for (double y = 199702.1; y < 199732; y += 2.9) EXPECT_NEAR(height(tin, x, y), 59, 1e-9) << x << ' ' << y;
  for (const double off : {0.01, 1.0, 7.0, 20.0}) {
    EXPECT_NEAR(height(tin, 300102 - off, 199715), 50, 1e-9);
    EXPECT_NEAR(height(tin, 300142 + off, 199715), 50, 1e-9);
  }
  const Store store(path("s.itin"));
  EXPECT_NEAR(store.greatest_feature_height(ThemeChoice::all(), {300120, 199710, 300121, 199711}), 9, 0.02);
  EXPECT_EQ(store.greatest_feature_height(ThemeChoice::none(), {300120, 199710, 300121, 199711}), 0);
  ASSERT_EQ(store.metadata().themes.size(), 1u);
  EXPECT_EQ(store.metadata().themes[0].features, 1u);
  EXPECT_EQ(store.metadata().themes[0].segments, 8u);
  EXPECT_EQ(store.metadata().themes[0].vertices, 8u);
}

/// Blocks are gone as soon as nobody holds them; sanitizers tell whether somebody should have.
TEST_F(RaisedFeatures, AreTheSameWithoutACache) {
  ground(10, [](int c, int r) { return 50.0 + (c * 7 + r * 5) % 4; });
  raise(ThemeKind::Buildings, "houses",
        {box(300102, 199702, 300142, 199732, 9), box(300042, 199642, 300062, 199662, 6)});
  const Store uncached(path("s.itin"), {0});
  NoProgress progress;
  EXPECT_EQ(triangles_of(triangulate(uncached, Window::all(), Detail::tolerance(0), progress, ThemeChoice::all())),
            triangles_of(whole(ThemeChoice::all())));
}

TEST_F(RaisedFeatures, ACourtyardIsGround) {
  ground(10, [](int c, int r) { return 50 + 0.1 * c + 0.05 * r; });
  LineFeature ring = box(300100, 199700, 300160, 199760, 12);
  test::write_lines(path("court.geojson"), {ring}, true);
  std::ifstream file(path("court.geojson"));
  std::string text((std::istreambuf_iterator<char>(file)), {});
  const auto end = text.find("]]}");
  text.insert(end + 1, ",[[300115,199715],[300115,199745],[300145,199745],[300145,199715],[300115,199715]]");
  std::ofstream(path("court.geojson")) << text;
  const Tin bare = whole(ThemeChoice::none());
  ImportOptions options;
  options.sources = {path("court.geojson")};
  options.kind = ThemeKind::Buildings;
  options.height_field = "h";
  NoProgress progress;
  EXPECT_EQ(import_lines(path("s.itin"), options, progress).features, 1u);
  const Tin tin = whole(ThemeChoice::all());
  EXPECT_NEAR(height(tin, 300130, 199730), height(bare, 300130, 199730), 1e-9);
  EXPECT_GT(height(tin, 300107, 199730), height(bare, 300107, 199730) + 5);
}

TEST_F(RaisedFeatures, ABlockOfHousesIsDroppedAsAWhole) {
  ground(10, [](int, int) { return 50.0; });
  // A terrace 30 m long, and a shed of 3 m.
  raise(ThemeKind::Buildings, "houses",
        {box(300102, 199702, 300112, 199712, 9), box(300112, 199702, 300122, 199712, 7),
         box(300122, 199702, 300132, 199712, 8), box(300202, 199702, 300205, 199704, 3)});
  const auto features = [&](double tolerance) {
    const Tin tin = whole(ThemeChoice::all(), tolerance);
    return std::array{height(tin, 300107, 199707), height(tin, 300117, 199707), height(tin, 300127, 199707),
                      height(tin, 300203.5, 199703)};
  };
  EXPECT_THAT(features(0), testing::Pointwise(testing::DoubleNear(1e-9), {59.0, 57.0, 58.0, 53.0}));
  EXPECT_THAT(features(2), testing::Pointwise(testing::DoubleNear(1e-9), {59.0, 57.0, 58.0, 53.0}));
  EXPECT_THAT(features(4), testing::Pointwise(testing::DoubleNear(1e-9), {59.0, 57.0, 58.0, 50.0}));
  EXPECT_THAT(features(16), testing::Pointwise(testing::DoubleNear(1e-9), {59.0, 57.0, 58.0, 50.0}));
  EXPECT_THAT(features(32), testing::Pointwise(testing::DoubleNear(1e-9), {50.0, 50.0, 50.0, 50.0}));
}

TEST_F(RaisedFeatures, WoodsFollowTheTerrainAndGiveWayToHouses) {
  ground(10, test::rolling);
  raise(ThemeKind::Vegetation, "woods", {box(300103, 199603, 300297, 199797, 15)});
  raise(ThemeKind::Buildings, "houses", {box(300181, 199681, 300199, 199699, 8)});
  const Tin bare = whole(ThemeChoice::none()), all = whole(ThemeChoice::all()),
            wood = whole(ThemeChoice::parse("woods"));
  for (double x = 300104; x < 300297; x += 7.3)
    for (double y = 199604; y < 199797; y += 8.1) EXPECT_NEAR(height(wood, x, y) - height(bare, x, y), 15, 0.05);
  EXPECT_NEAR(height(all, 300190, 199690), height(whole(ThemeChoice::parse("houses")), 300190, 199690), 1e-9);
  EXPECT_NEAR(height(all, 300120, 199620) - height(bare, 300120, 199620), 15, 0.05);
}

TEST_F(RaisedFeatures, TerracesFollowTheTerrainWhereHousesAreLevel) {
  ground(10, test::rolling);
  const Tin bare = whole(ThemeChoice::none());
  const std::vector<LineFeature> rows{box(300103, 199603, 300297, 199615, 30)};
  EXPECT_EQ(raise(ThemeKind::Terraces, "rows", rows).features, 1u);
  const Tin terrace = whole(ThemeChoice::parse("rows"));
  double lowest = 1e9, highest = -1e9;
  for (double x = 300104; x < 300297; x += 3.7)
    for (double y = 199604; y < 199615; y += 2.1) {
      EXPECT_NEAR(height(terrace, x, y) - height(bare, x, y), 30, 0.05) << x << ' ' << y;
      lowest = std::min(lowest, height(terrace, x, y)), highest = std::max(highest, height(terrace, x, y));
    }
  EXPECT_GT(highest - lowest, 5);
  // One house of that footprint has a level roof.
  raise(ThemeKind::Buildings, "houses", rows);
  const Tin house = whole(ThemeChoice::parse("houses"));
  EXPECT_NEAR(height(house, 300110, 199609), height(house, 300290, 199609), 1e-9);
  // Its walls stand where the terrace's do.
  EXPECT_NEAR(height(house, 300102.9, 199609), height(terrace, 300102.9, 199609), 1e-9);
  expect_sound();
  const Store store(path("s.itin"));
  EXPECT_EQ(store.metadata().themes.at(0).kind, ThemeKind::Buildings);
  EXPECT_EQ(store.metadata().themes.at(1).kind, ThemeKind::Terraces);
}

TEST_F(RaisedFeatures, FeaturesFollowWhenTheirGroundChanges) {
  ground(10, [](int, int) { return 50.0; });
  raise(ThemeKind::Buildings, "houses", {box(300102, 199702, 300142, 199732, 9)});
  EXPECT_NEAR(height(whole(ThemeChoice::all()), 300120, 199715), 59, 1e-9);
  // Finer ground, 20 m higher, replaces the coarse one.
  test::write_raster(path("fine.tif"), {300050, 199800, 2, 80, 80, 27700}, [](int, int) { return 70.0; });
  ImportOptions options;
  options.sources = {path("fine.tif")};
  options.replace = true;
  NoProgress progress;
  import_terrain(path("s.itin"), options, progress);
  expect_sound();
  EXPECT_NEAR(height(whole(ThemeChoice::all()), 300120, 199715), 79, 1e-9);
  EXPECT_NEAR(height(whole(ThemeChoice::none()), 300120, 199715), 70, 1e-9);
  EXPECT_THAT(directory_.names(), testing::Not(testing::Contains(testing::HasSubstr("ground"))));
}

TEST_F(RaisedFeatures, WhatCannotStandIsNamed) {
  ground(10, [](int, int) { return 50.0; });
  const ImportReport report = raise(ThemeKind::Buildings, "houses",
                                    {box(300102, 199702, 300142, 199732, 9), box(300580, 199702, 300700, 199732, 9),
                                     box(299000, 199702, 299010, 199732, 9), box(300202, 199702, 300242, 199732, -3)});
  EXPECT_EQ(report.features, 1u);
  EXPECT_EQ(report.refused, 3u);
  EXPECT_EQ(report.warnings.size(), 3u);
  EXPECT_THAT(report.warnings, testing::Contains(testing::HasSubstr("height of -3")));
  EXPECT_THROW(add(ThemeKind::Buildings, "houses", {box(300302, 199702, 300342, 199732, 9)}), InputError);
  EXPECT_THROW(raise(ThemeKind::Walls, "houses", {box(300302, 199702, 300342, 199732, 9)}), InputError);
}

/// The lower house has no ground of its own there before the higher one is left out.
TEST_F(RaisedFeatures, WhatALeftOutHouseCoveredOverAVoidIsNotBuiltEither) {
  ground(10, [](int c, int r) { return std::hypot(c - 25, r - 25) < 2 ? std::nan("") : 50.0; });
  const ImportReport report = raise(ThemeKind::Buildings, "houses",
                                    {box(300200, 199720, 300310, 199770, 12), box(300180, 199735, 300330, 199755, 9)});
  EXPECT_EQ(report.features, 0u);
  EXPECT_EQ(report.refused, 2u);
  expect_sound();
}

/// In every cell, what stands is at most as much above the ground as the store says.
TEST_F(RaisedFeatures, NothingRisesAboveTheGreatestHeight) {
  ground(10, test::rolling);
  std::vector<LineFeature> houses, woods;
  for (int i = 0; i < 12; ++i)
    houses.push_back(box(300020 + 41 * i, 199450 + 31 * i, 300040 + 43 * i, 199465 + 32 * i, 4 + i));
  raise(ThemeKind::Buildings, "houses", houses);
  raise(ThemeKind::Vegetation, "woods", {box(300103, 199803, 300297, 199897, 15)});
  const Store store(path("s.itin"));
  for (const char* theme : {"houses", "woods"}) {
    const ThemeChoice choice = ThemeChoice::parse(theme);
    const Tin bare = whole(ThemeChoice::none()), tin = whole(choice);
    const TerrainHeights low(bare), high(tin);
    double greatest = 0;
    for (const Triangle& t : tin.triangles) {
      if (tin.theme(t) == 0) continue;
      const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
      const Point2 p{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
      const GridPoint at = tin.grid.quantise({p.x, p.y, 0});
      const double rise = *high.height_at({at.x, at.y}) - *low.height_at({at.x, at.y});
      EXPECT_LE(rise, store.greatest_feature_height(choice, {p.x, p.y, p.x, p.y}) + 1e-9);
      greatest = std::max(greatest, rise);
    }
    EXPECT_GT(greatest, 3);
  }
}

/// A surface model made by others: what stands brings the terrain closer to it within the footprints, and leaves it
/// alone outside.
TEST_F(RaisedFeatures, AlexandriaComesCloserToItsSurfaceModel) {
  const std::string data = std::string(ITIN_DATA_DIR) + "/alexandria-va-2m/";
  if (!std::filesystem::exists(data + "dsm.tif")) GTEST_SKIP() << data << " is not there";
  NoProgress progress;
  ImportOptions options;
  options.sources = {data + "dtm.tif"};
  import_terrain(path("s.itin"), options, progress);
  options.sources = {data + "buildings.geojson"};
  options.kind = ThemeKind::Buildings;
  options.height_field = "HEIGHT";
  EXPECT_GT(import_lines(path("s.itin"), options, progress).features, 75u);
  const Tin bare = whole(ThemeChoice::none()), tin = whole(ThemeChoice::all());
  const TerrainHeights low(bare), high(tin);
  GDALAllRegister();
  const GDALDatasetUniquePtr dataset(GDALDataset::Open((data + "dsm.tif").c_str(), GDAL_OF_RASTER));
  ASSERT_TRUE(dataset);
  std::array<double, 6> affine{};
  dataset->GetGeoTransform(affine.data());
  const int columns = dataset->GetRasterXSize(), rows = dataset->GetRasterYSize();
  std::vector<double> dsm(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  ASSERT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, columns, rows, dsm.data(), columns, rows, GDT_Float64, 0,
                                                0, nullptr),
            CE_None);
  std::array<std::vector<double>, 4> errors;  // inside: with, without; outside: with, without
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double z =
          dsm[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c)];
      const GridPoint p = tin.grid.quantise({affine[0] + (c + 0.5) * affine[1], affine[3] + (r + 0.5) * affine[5], 0});
      const auto with = high.height_at({p.x, p.y}), without = low.height_at({p.x, p.y});
      if (!with || !without || z < -100) continue;
      const std::size_t inside = *with > *without + 2 ? 0 : 2;
      errors[inside].push_back(std::abs(*with - z));
      errors[inside + 1].push_back(std::abs(*without - z));
    }
  }
  const std::array names{"inside footprints, with buildings", "inside footprints, bare terrain",
                         "outside, with buildings", "outside, bare terrain"};
  std::array<double, 4> medians{};
  for (std::size_t i = 0; i < 4; ++i) {
    std::sort(errors[i].begin(), errors[i].end());
    ASSERT_FALSE(errors[i].empty());
    const auto at = [&](double share) {
      return errors[i][static_cast<std::size_t>(share * (double(errors[i].size()) - 1))];
    };
    medians[i] = at(0.5);
    std::cout << names[i] << ": " << errors[i].size() << " cells, |error| 50 % " << at(0.5) << " m, 75 % " << at(0.75)
              << " m, 90 % " << at(0.9) << " m\n";
  }
  EXPECT_LT(medians[0], medians[1] / 2);
  EXPECT_LT(medians[0], 1.5) << "the surface model's own buildings are no better known than that";
  EXPECT_EQ(medians[2], medians[3]) << "the ground outside of footprints is the bare one";
  expect_only_raised(bare, tin);
}

/// The heights of the Delft buildings against those of the city's own model.
TEST_F(RaisedFeatures, DelftHasItsRoofs) {
  const std::string model = std::string(ITIN_DATA_DIR) + "/ahn3-bgt-delft/output/testarea.json";
  const std::string points = std::string(ITIN_DATA_DIR) + "/derived-las/ahn3_cropped_2.las";
  if (!std::filesystem::exists(model) || !std::filesystem::exists(points)) GTEST_SKIP() << model << " is not there";
  NoProgress progress;
  ImportOptions terrain;
  terrain.sources = {points};
  terrain.classes = {2, 9};
  terrain.crs = "EPSG:28992";
  import_terrain(path("s.itin"), terrain, progress);
  ImportOptions options;
  options.sources = {model};
  options.kind = ThemeKind::Buildings;
  options.theme = "buildings";
  options.crs = "EPSG:28992";
  const ImportReport report = import_lines(path("s.itin"), options, progress);
  std::cout << report.features << " buildings stand, " << report.refused << " do not, " << report.seconds << " s\n";
  EXPECT_GT(report.features, 15u);
  expect_sound();
  const Tin tin = whole(ThemeChoice::all());
  const TerrainHeights heights(tin);
  const nlohmann::json city = nlohmann::json::parse(std::ifstream(model));
  std::vector<double> errors;
  for (const auto& [name, object] : city.at("CityObjects").items()) {
    if (object.at("type") != "Building" || !object.at("attributes").contains("measuredHeight")) continue;
    // The middle of the box about the building's vertices, where it lies in the building. Heights were measured from
    // the lowest surface.
    const nlohmann::json& attributes = object.at("attributes");
    const double top =
        attributes.at("measuredHeight").get<double>() + attributes.at("min-height-surface").get<double>();
    Box box;
    const std::function<void(const nlohmann::json&)> visit = [&](const nlohmann::json& boundary) {
      if (boundary.is_array()) {
        for (const auto& inner : boundary) visit(inner);
        return;
      }
      const auto& v = city.at("vertices").at(boundary.get<std::size_t>());
      box.extend(Point2{v[0].get<double>(), v[1].get<double>()});
    };
    visit(object.at("geometry").at(0).at("boundaries"));
    const GridPoint middle = tin.grid.quantise({(box.xmin + box.xmax) / 2, (box.ymin + box.ymax) / 2, 0});
    const auto z = heights.height_at({middle.x, middle.y});
    if (z && *z > top - 3) errors.push_back(std::abs(*z - top));
  }
  std::sort(errors.begin(), errors.end());
  ASSERT_GT(errors.size(), 10u);
  std::cout << errors.size() << " roofs, median error " << errors[errors.size() / 2] << " m, 90 % within "
            << errors[errors.size() * 9 / 10] << " m\n";
  EXPECT_LT(errors[errors.size() * 9 / 10], 0.02);
  expect_only_raised(whole(ThemeChoice::none()), tin);
}

}  // namespace
}  // namespace itin
