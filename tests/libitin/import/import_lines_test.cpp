// Lines in a store: law 1 with constraints against a global triangulation, certificates, themes, later additions.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <gmock/gmock.h>
#include <map>
#include <random>
#include <set>
#include <string_view>
#include <utility>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/parallel.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "features/plan/hot_pixel.hpp"
#include "store/codec/point_index.hpp"
#include "support/corner_triangles.hpp"
#include "support/raster_file.hpp"
#include "support/real_terrain.hpp"
#include "support/seed.hpp"
#include "support/sound_store.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"
#include "triangulate/apex/selection.hpp"
#include "triangulate/mesh/delaunay.hpp"

namespace itin {
namespace {

using test::LineFeature;
using test::TriangleCorners;
using test::triangles_of;

/// The content of a store, read leaf by leaf, without the triangulation under test.
struct Content {
  std::vector<GridPoint> points;
  std::vector<Segment> segments;
};

Content content(const Store& store, const Detail& detail, const ThemeChoice& choice) {
  const StoreMetadata& metadata = store.metadata();
  std::vector<double> tolerances;
  for (const LevelInfo& level : metadata.levels) tolerances.push_back(level.tolerance);
  const Selection selection(detail, tolerances, metadata.grid);
  const auto chosen = [&](std::uint16_t theme) { return theme == 0 || choice.includes(metadata.themes[theme - 1u]); };
  Content result;
  std::vector<Leaf> leaves;
  store.points().leaves({}, store.points().bounds(), leaves);
  std::set<GridPoint> points;
  for (const Leaf& leaf : leaves) {
    if (!chosen(leaf.theme)) continue;
    const auto block = store.points().block(leaf);
    for (std::size_t k = 0; k < block->points.size(); ++k) {
      const GridPoint& p = block->points[k];
      if (selection.selects(level_of(leaf, *block, k), p.x, p.y)) points.insert(p);
    }
  }
  result.points.assign(points.begin(), points.end());
  std::vector<Segment> segments;
  store.points().segments(store.points().bounds(), segments);
  for (const Segment& s : std::set<Segment>(segments.begin(), segments.end())) {
    if (chosen(s.theme) && selection.selects(s)) result.segments.push_back(s);
  }
  return result;
}

/// The global triangulation, ground or not.
std::set<TriangleCorners> global(const Content& content) {
  std::vector<Position> positions;
  std::map<Position, std::uint32_t> number;
  for (const GridPoint& p : content.points) {
    EXPECT_TRUE(number.emplace(Position{p.x, p.y}, static_cast<std::uint32_t>(positions.size())).second);
    positions.push_back({p.x, p.y});
  }
  Delaunay delaunay;
  delaunay.insert(positions);
  std::vector<Delaunay::Constraint> constraints;
  for (const Segment& s : content.segments) constraints.emplace_back(number.at({s.ax, s.ay}), number.at({s.bx, s.by}));
  delaunay.constrain(constraints);
  std::set<TriangleCorners> result;
  for (const auto& t : delaunay.mesh().triangles) {
    TriangleCorners c{content.points[t[0]], content.points[t[1]], content.points[t[2]]};
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    result.insert(c);
  }
  return result;
}

class ImportLines : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }

  ImportReport lines(ThemeKind kind, const std::string& file, const std::string& theme = "",
                     const std::string& store = "s.itin", bool stay = false) const {
    ImportOptions options;
    options.stay = stay;
    options.sources = {path(file)};
    options.kind = kind;
    options.theme = theme;
    NoProgress progress;
    return import_lines(path(store), options, progress);
  }

  /// 60 x 60 posts of real terrain, 50 m apart, from 300000, 197000 to 303000, 200000, perhaps with a void.
  void import_terrain_tile(bool with_void, const std::string& store = "s.itin") const {
    test::write_raster(path("t.tif"), {300000, 200000, 50, 60, 60, 27700}, [&](int c, int r) {
      return with_void && (c - 40) * (c - 40) + (r - 20) * (r - 20) < 60 ? std::nan("") : terrain_(c + 400, r + 100);
    });
    ImportOptions options;
    options.sources = {path("t.tif")};
    NoProgress progress;
    import_terrain(path(store), options, progress);
  }

  std::vector<LineFeature> random_lines(std::mt19937& random, int count, bool polygons) const {
    const auto in = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() % 100000) / 100000;
    };
    std::vector<LineFeature> features;
    for (int i = 0; i < count; ++i) {
      LineFeature f;
      f.polygon = polygons;
      Point3 p{in(300100, 302900), in(197100, 199900), in(100, 300)};
      for (int k = 0; k < 8; ++k) {
        f.vertices.push_back(p);
        p = {p.x + in(-300, 300), p.y + in(-300, 300), in(100, 300)};
      }
      if (polygons) f.vertices.push_back(f.vertices.front());
      features.push_back(f);
    }
    return features;
  }

  test::TemporaryDirectory directory_;
  test::CardiffTerrain terrain_;
};

/// Windows, and the whole, at every level and with several choices of themes.
void expect_windows_of_the_whole_by_level(const Store& store, std::mt19937& random,
                                          const std::vector<ThemeChoice>& choices, std::size_t every_level = 1) {
  NoProgress progress;
  const StoreMetadata& metadata = store.metadata();
  const Box bounds = metadata.grid.box(metadata.bounds);
  std::vector<Detail> details;
  for (const LevelInfo& level : metadata.levels) details.push_back(Detail::tolerance(level.tolerance));
  const Point2 centre{(bounds.xmin + bounds.xmax) / 2, (bounds.ymin + bounds.ymax) / 2};
  details.push_back(Detail::rings(centre, {{bounds.width() / 8, 0}, {bounds.width() / 4, 2}, {bounds.width(), 32}}));
  for (const ThemeChoice& choice : choices) {
    for (std::size_t k = 0; k < details.size(); k += every_level) {
      const Detail& detail = details[k];
      const Content all = content(store, detail, choice);
      const std::set<TriangleCorners> truth = global(all);
      const Tin whole = triangulate(store, Window::all(), detail, progress, choice);
      const std::set<TriangleCorners> found = triangles_of(whole);
      ASSERT_FALSE(found.empty());
      ASSERT_TRUE(std::includes(truth.begin(), truth.end(), found.begin(), found.end())) << "level " << k;
      // Every segment is there, as edges.
      std::map<std::uint16_t, double> length, expected;
      for (const LineEdge& e : whole.lines) {
        const Point3 a = whole.point(e.from), b = whole.point(e.to);
        length[e.theme] += std::hypot(a.x - b.x, a.y - b.y);
      }
      // The two halves of a narrow ring may have become one and the same segment.
      std::set<std::array<std::int32_t, 5>> distinct;
      for (const Segment& s : all.segments) {
        if (s.theme == kCoverage || !distinct.insert({s.ax, s.ay, s.bx, s.by, s.theme}).second) continue;
        expected[s.theme] += std::hypot(double(s.ax) - s.bx, double(s.ay) - s.by) * metadata.grid.resolution;
      }
      ASSERT_EQ(length.size(), expected.size());
      for (const auto& [theme, metres] : expected) ASSERT_NEAR(length[theme], metres, 1e-6 * metres);
      for (int i = 0; i < 6; ++i) {
        const auto in = [&](double low, double high) {
          return low + (high - low) * static_cast<double>(random() % 1000) / 1000;
        };
        const double x = in(bounds.xmin, bounds.xmax), y = in(bounds.ymin, bounds.ymax), side = in(5, 900);
        const Window window = i % 2 == 0 ? Window::box({x, y, x + side, y + side}) : Window::disc({x, y}, side);
        const std::set<TriangleCorners> part = triangles_of(triangulate(store, window, detail, progress, choice));
        ASSERT_TRUE(std::includes(found.begin(), found.end(), part.begin(), part.end())) << "level " << k;
        for (const TriangleCorners& c : found) {
          const Box box = [&] {
            Box b;
            for (const GridPoint& p : c) b.extend(Point2{metadata.grid.point(p).x, metadata.grid.point(p).y});
            return b;
          }();
          // Wholly inside a box window, so surely in it.
          const bool within = box.xmin >= x && box.xmax <= x + side && box.ymin >= y && box.ymax <= y + side;
          ASSERT_TRUE(i % 2 == 1 || !within || part.contains(c)) << "level " << k;
        }
      }
    }
  }
}

TEST_F(ImportLines, WindowEqualsWholeWithConstraints) {
  std::mt19937 random(test::seed());
  for (const bool with_void : {false, true}) {
    std::filesystem::remove(path("s.itin"));
    import_terrain_tile(with_void);
    test::write_lines(path("ridges.geojson"), random_lines(random, 12, false));
    test::write_lines(path("lakes.geojson"), random_lines(random, 5, true));
    test::write_lines(path("roads.geojson"), random_lines(random, 12, false), true);
    const ImportReport report = lines(ThemeKind::Breaklines, "ridges.geojson", "ridges");
    EXPECT_EQ(report.features, 12u);
    EXPECT_GT(report.crossings, 0u);
    lines(ThemeKind::Roads, "roads.geojson");
    lines(ThemeKind::Water, "lakes.geojson", "lakes");
    const Store store(path("s.itin"));
    NoProgress progress;
    test::expect_sound(store);
    ASSERT_EQ(store.metadata().themes.size(), 3u);
    EXPECT_EQ(store.metadata().themes[0].name, "lakes");
    EXPECT_EQ(store.metadata().themes[1].name, "ridges");
    EXPECT_EQ(store.metadata().themes[2].name, "roads");
    expect_windows_of_the_whole_by_level(store, random, {ThemeChoice::none(), ThemeChoice::all().with_ground_lines()});
  }
}

TEST_F(ImportLines, RoadsTakeTheTerrainsHeightAndLeaveItAsItWas) {
  std::mt19937 random(7);
  import_terrain_tile(false);
  NoProgress progress;
  const std::set<TriangleCorners> before =
      triangles_of(triangulate(Store(path("s.itin")), Window::all(), Detail::tolerance(0), progress));
  test::write_lines(path("roads.geojson"), random_lines(random, 20, false), true);
  lines(ThemeKind::Roads, "roads.geojson");
  const Store store(path("s.itin"));
  EXPECT_EQ(triangles_of(triangulate(store, Window::all(), Detail::tolerance(0), progress)), before);
  const Tin with = triangulate(store, Window::all(), Detail::tolerance(0), progress,
                               ThemeChoice::parse("roads").with_ground_lines());
  std::size_t draped = 0;
  for (const GridPoint& p : with.vertices) {
    for (const TriangleCorners& c : before) {
      const std::int64_t wa = doubled_area(p, c[1], c[2]), wb = doubled_area(c[0], p, c[2]),
                         wc = doubled_area(c[0], c[1], p);
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const double z =
          (static_cast<double>(wa) * c[0].z + static_cast<double>(wb) * c[1].z + static_cast<double>(wc) * c[2].z) /
          static_cast<double>(wa + wb + wc);
      EXPECT_NEAR(p.z, z, 0.50001);
      draped += wa != 0 && wb != 0 && wc != 0;
      break;
    }
  }
  EXPECT_GT(draped, 100u);
}

/// A line's vertex on a post takes its place but leaves it ground, however often the store is written.
TEST_F(ImportLines, VerticesOnPostsLeaveNoHole) {
  import_terrain_tile(false);
  test::write_lines(path("ridge.geojson"), {{{{300525, 197525, 900}, {301525, 198525, 910}, {302525, 197525, 920}}}});
  test::write_lines(path("cliff.geojson"), {{{{300625, 199125, 500}, {300725, 199125, 510}}}});
  const auto expect_whole = [&](const std::string& when) {
    NoProgress progress;
    const Tin tin = triangulate(Store(path("s.itin")), Window::all(), Detail::tolerance(0), progress);
    std::int64_t area = 0;
    for (const Triangle& t : tin.triangles)
      area += doubled_area(tin.vertices[t[0]], tin.vertices[t[1]], tin.vertices[t[2]]);
    EXPECT_EQ(area, 2 * std::int64_t{295000} * 295000) << when;
    for (const GridPoint& ridge : {tin.grid.quantise({301525, 198525, 910}), tin.grid.quantise({302525, 197525, 920})})
      EXPECT_NE(std::find(tin.vertices.begin(), tin.vertices.end(), ridge), tin.vertices.end())
          << when << ": height " << ridge.z;
  };
  lines(ThemeKind::Breaklines, "ridge.geojson", "ridge", "s.itin", true);
  expect_whole("with a ridge");
  lines(ThemeKind::Breaklines, "cliff.geojson", "cliff", "s.itin", true);
  expect_whole("written again");
  // Finer ground, on the same posts and between them, takes the place of all posts but not of lines that stay.
  test::write_raster(path("fine.tif"), {300012.5, 199987.5, 25, 119, 119, 27700}, [&](int, int) { return 100.0; });
  ImportOptions options;
  options.sources = {path("fine.tif")};
  options.replace = true;
  NoProgress progress;
  import_terrain(path("s.itin"), options, progress);
  expect_whole("replaced");
  EXPECT_EQ(Store(path("s.itin")).metadata().themes[1].segments, 80U) << "a vertex at each post on its way";
}

TEST_F(ImportLines, ThemesDoNotDependOnTheOrderOfImportBeyondTheGrid) {
  std::mt19937 random(3);
  for (const char* store : {"a.itin", "b.itin"}) import_terrain_tile(false, store);
  // Far apart, so that nothing is rounded twice.
  test::write_lines(path("one.geojson"), {{{{300500, 197500, 10}, {301500, 198100, 20}, {302500, 197500, 30}}}});
  test::write_lines(path("two.geojson"), {{{{300500, 199500, 10}, {301500, 198900, 20}, {302500, 199500, 30}}}});
  lines(ThemeKind::Breaklines, "one.geojson", "one", "a.itin");
  lines(ThemeKind::Breaklines, "two.geojson", "two", "a.itin");
  lines(ThemeKind::Breaklines, "two.geojson", "two", "b.itin");
  lines(ThemeKind::Breaklines, "one.geojson", "one", "b.itin");
  NoProgress progress;
  for (const double tolerance : {0.0, 2.0, 32.0}) {
    const Tin a = triangulate(Store(path("a.itin")), Window::all(), Detail::tolerance(tolerance), progress);
    const Tin b = triangulate(Store(path("b.itin")), Window::all(), Detail::tolerance(tolerance), progress);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.lines, b.lines);
  }
}

TEST_F(ImportLines, WhatLeavesTheGroundIsLeftOut) {
  import_terrain_tile(true);
  // Across the void, beyond the border, and one on the ground.
  test::write_lines(path("l.geojson"), {{{{301500, 199000, 10}, {302500, 199000, 10}}},
                                        {{{300500, 198000, 10}, {299000, 198000, 10}}},
                                        {{{300500, 198500, 10}, {300900, 198500, 10}}}});
  const ImportReport report = lines(ThemeKind::Breaklines, "l.geojson");
  EXPECT_EQ(report.left_out, 2u);
  EXPECT_EQ(Store(path("s.itin")).metadata().themes[0].segments, 1u);
}

/// It is laid again with all that is imported later.
TEST_F(ImportLines, WhatWasLeftOutTakesMemoryToo) {
  import_terrain_tile(false);
  LineFeature beyond, within{{{300500, 198000, 0}, {300600, 198000, 0}}};
  for (int i = 0; i < 20000; ++i) beyond.vertices.push_back({310000.0 + i, 198000.0 + i % 7, 0});
  test::write_lines(path("l.geojson"), {beyond, within}, true);
  test::write_lines(path("m.geojson"), {within}, true);
  lines(ThemeKind::Roads, "l.geojson");
  ImportOptions options;
  options.sources = {path("m.geojson")};
  options.kind = ThemeKind::Walls;
  options.memory_bytes = 8 << 20;
  NoProgress progress;
  EXPECT_THROW(import_lines(path("s.itin"), options, progress), InputError);
  options.memory_bytes = 80 << 20;
  EXPECT_NO_THROW(import_lines(path("s.itin"), options, progress));
}

/// From its very beginning: what another import changed in a store that is read already would be lost.
TEST_F(ImportLines, AnotherMeanwhileIsRefused) {
  struct Meanwhile final : public Progress {
    explicit Meanwhile(std::function<void()> call) : call_(std::move(call)) {}
    void report(std::string_view, double) override {
      if (call_) std::exchange(call_, nullptr)();
    }
    std::function<void()> call_;
  };
  import_terrain_tile(false);
  test::write_lines(path("roads.geojson"), {{{{300500, 198000, 0}, {300600, 198000, 0}}}}, true);
  test::write_lines(path("houses.geojson"), {test::box(300510, 198010, 300530, 198020, 7)});
  std::string refusal = "none";
  Meanwhile meanwhile([&] {
    try {
      lines(ThemeKind::Roads, "roads.geojson");
    } catch (const FileError& e) {
      refusal = e.what();
    }
  });
  ImportOptions options;
  options.sources = {path("houses.geojson")};
  options.kind = ThemeKind::Buildings;
  options.height_field = "h";
  import_lines(path("s.itin"), options, meanwhile);
  EXPECT_THAT(refusal, testing::HasSubstr("s.itin: another import is writing this store; wait for it to end"));
  const Store store(path("s.itin"));
  ASSERT_EQ(store.metadata().themes.size(), 1U);
  EXPECT_EQ(store.metadata().themes[0].name, "buildings");
}

TEST_F(ImportLines, MistakesAreNamed) {
  const auto expect_error = [&](const auto& call, const std::string& text) {
    try {
      call();
      FAIL() << "nothing was thrown; expected " << text;
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr(text));
    }
  };
  test::write_lines(path("flat.geojson"), {{{{300500, 198000, 0}, {300600, 198000, 0}}}}, true);
  expect_error([&] { lines(ThemeKind::Roads, "flat.geojson"); }, "import terrain first");
  import_terrain_tile(false);
  expect_error([&] { lines(ThemeKind::Breaklines, "flat.geojson"); }, "`z_field`");
  expect_error([&] { lines(ThemeKind::Roads, "flat.geojson", "all"); }, "choose a name");
  lines(ThemeKind::Roads, "flat.geojson", "lanes");
  expect_error([&] { lines(ThemeKind::Walls, "flat.geojson", "lanes"); }, "holds roads already");
  NoProgress progress;
  expect_error(
      [&] {
        triangulate(Store(path("s.itin")), Window::all(), Detail::tolerance(0), progress,
                    ThemeChoice::parse("lane").with_ground_lines());
      },
      "it has lanes");
}

TEST(ImportContours, WindowEqualsWholeOnRealContours) {
  const std::string gml = std::string(ITIN_DATA_DIR) + "/os-terrain50-contours-sk00/SK00.gml";
  if (!std::filesystem::exists(gml)) GTEST_SKIP() << gml << " is not there";
  const test::TemporaryDirectory directory;
  ImportOptions options;
  options.sources = {gml};
  options.layer = "ContourLine";
  options.z_field = "propertyValue";
  options.kind = ThemeKind::Contours;
  NoProgress progress;
  import_lines(directory.file("c.itin"), options, progress);
  options.layer = "SpotHeight";
  options.kind.reset();
  import_terrain(directory.file("c.itin"), options, progress);
  const Store store(directory.file("c.itin"));
  test::expect_sound(store);
  EXPECT_EQ(store.metadata().themes[0].features, 322u);
  std::mt19937 random(test::seed());
  expect_windows_of_the_whole_by_level(store, random, {ThemeChoice::none()}, 4);
}

}  // namespace
}  // namespace itin
