// The content of a store is a function of the set of its sources: whatever the order of import, and in whatever
// portions.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <iterator>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "store/codec/point_index.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

using test::LineFeature;
using test::RasterShape;

/// One import.
struct Source {
  std::string what;
  ImportOptions options;
};

std::string bytes_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Every byte, and every row by its digest. Where these tell the stores apart, the rest says in what: vertices,
/// triangles and lines of all levels with and without what stands, certificates, the segments and parts of all themes.
void expect_same_store(const std::string& a, const std::string& b) {
  const Store first(a), second(b);
  const StoreMetadata &one = first.metadata(), &other = second.metadata();
  NoProgress progress;
  EXPECT_EQ(content_digest(first, progress), content_digest(second, progress));
  EXPECT_TRUE(bytes_of_file(a) == bytes_of_file(b));
  EXPECT_EQ(one.vertices, other.vertices);
  EXPECT_EQ(one.parts, other.parts);
  ASSERT_EQ(one.levels.size(), other.levels.size());
  ASSERT_EQ(one.themes.size(), other.themes.size());
  for (std::size_t t = 0; t < one.themes.size(); ++t) {
    EXPECT_EQ(one.themes[t].name, other.themes[t].name);
    EXPECT_EQ(one.themes[t].features, other.themes[t].features) << one.themes[t].name;
    EXPECT_EQ(one.themes[t].vertices, other.themes[t].vertices) << one.themes[t].name;
    EXPECT_EQ(one.themes[t].segments, other.themes[t].segments) << one.themes[t].name;
  }
  for (std::size_t k = 0; k < one.levels.size(); ++k) {
    EXPECT_EQ(one.levels[k].vertices, other.levels[k].vertices) << "level " << k;
    EXPECT_EQ(one.levels[k].certified_error.lo, other.levels[k].certified_error.lo) << "level " << k;
    EXPECT_EQ(one.levels[k].certified_error.hi, other.levels[k].certified_error.hi) << "level " << k;
    for (const ThemeChoice& themes : {ThemeChoice::none(), ThemeChoice::all().with_ground_lines()}) {
      const Detail detail = Detail::tolerance(one.levels[k].tolerance);
      const Tin t = triangulate(first, Window::all(), detail, progress, themes),
                u = triangulate(second, Window::all(), detail, progress, themes);
      EXPECT_EQ(t.vertices == u.vertices, true)
          << "level " << k << ", " << t.vertices.size() << " and " << u.vertices.size();
      EXPECT_EQ(t.triangles == u.triangles, true) << "level " << k;
      EXPECT_EQ(t.lines == u.lines, true) << "level " << k;
    }
  }
  std::vector<Segment> s, r;
  first.points().segments(first.points().bounds(), s);
  second.points().segments(second.points().bounds(), r);
  for (std::vector<Segment>* all : {&s, &r}) {
    std::sort(all->begin(), all->end());
    all->erase(std::unique(all->begin(), all->end()), all->end());
  }
  EXPECT_EQ(s == r, true);
}

class ImportOrder : public testing::Test {
 protected:
  ImportOrder() { ::setenv("SOURCE_DATE_EPOCH", "1700000000", 1); }
  ~ImportOrder() override { ::unsetenv("SOURCE_DATE_EPOCH"); }

  std::string path(const std::string& name) const { return directory_.file(name); }

  double in(double low, double high) { return low + (high - low) * static_cast<double>(random_() % 1000000) / 1e6; }
  bool chance(unsigned of) { return random_() % of == 0; }

  Source terrain(const std::string& name, const RasterShape& shape, bool replace, bool with_void) {
    const double x = in(5, shape.columns - 5.0), y = in(5, shape.rows - 5.0), phase = in(0, 6);
    test::write_raster(path(name + ".tif"), shape, [&](int c, int r) {
      if (with_void && std::hypot(c - x, r - y) < 3) return std::nan("");
      const double east = shape.xmin + c * shape.step, north = shape.ymax - r * shape.step;
      return 100 + 20 * std::sin(east / 170 + phase / 50) + 15 * std::cos(north / 130) +
             3 * std::sin(east / 23 + north / 31 + phase);
    });
    ImportOptions options;
    options.sources = {path(name + ".tif")};
    options.replace = replace;
    return {name + (replace ? " replacing" : ""), options};
  }

  /// Some of them too far from the others to be ground.
  Source scattered() {
    std::ofstream out(path("points.csv"));
    out << "x,y,z\n";
    for (int i = 0; i < 150; ++i)
      out << fmt::format("{:.2f},{:.2f},{:.2f}\n", in(299700, 301100), in(198900, 200200), in(80, 130));
    ImportOptions options;
    options.sources = {path("points.csv")};
    options.crs = "EPSG:27700";
    options.max_gap = 60;
    return {"points", options};
  }

  /// Part of it beyond the coarse ground now and then, part of it too low to stand.
  Source heights(ThemeKind kind) {
    const RasterShape shape{in(299950, 300900), in(199100, 200050), in(3, 9), 12, 10, 27700};
    const std::string file = path("heights" + std::to_string(files_++) + ".tif");
    const double ground = kind == ThemeKind::Surface ? 100 : 0;
    test::write_raster(file, shape, [&](int, int) { return chance(9) ? std::nan("") : ground + in(-3, 25); });
    ImportOptions options;
    options.sources = {file};
    options.kind = kind;
    options.theme = name_of(kind);
    options.height_step = 4;
    return {options.theme + " raster", options};
  }

  Source lines(ThemeKind kind, const std::string& theme, const std::vector<LineFeature>& features, bool raised) {
    const std::string file = path(theme + std::to_string(files_++) + ".geojson");
    test::write_lines(file, features);
    ImportOptions options;
    options.sources = {file};
    options.kind = kind;
    options.theme = theme;
    if (raised) options.height_field = "h";
    if (raised && kind == ThemeKind::Buildings && chance(2)) options.foundation = Foundation::flat;
    options.stay = is_terrain(kind) && chance(3);
    return {theme + (options.stay ? " staying" : ""), options};
  }

  /// Over the edge of the coarse ground, now and then through its posts.
  std::vector<LineFeature> random_lines(int count, double step, double level = -1) {
    std::vector<LineFeature> features;
    for (int i = 0; i < count; ++i) {
      LineFeature f;
      Point3 p{in(300000, 300950), in(199050, 200000), level < 0 ? in(80, 130) : level};
      for (int k = 0; k < 5; ++k) {
        if (chance(4))
          p = {300025 + 50 * std::round((p.x - 300025) / 50), 199975 - 50 * std::round((199975 - p.y) / 50), p.z};
        f.vertices.push_back(p);
        p = {p.x + in(-step, step), p.y + in(-step, step), level < 0 ? in(80, 130) : level};
      }
      features.push_back(f);
    }
    return features;
  }

  std::vector<LineFeature> random_boxes(int count, double side) {
    std::vector<LineFeature> features;
    for (int i = 0; i < count; ++i) {
      const double x = in(300040, 300900), y = in(199060, 199900), w = in(5, side), h = in(5, side), turn = in(0, 1.5);
      LineFeature f = test::box(0, 0, w, h, in(4, 30));
      for (Point3& p : f.vertices)
        p = {x + p.x * std::cos(turn) - p.y * std::sin(turn), y + p.x * std::sin(turn) + p.y * std::cos(turn), 0};
      features.push_back(f);
    }
    return features;
  }

  /// Terrain, which may come first, and sources of all other kinds.
  std::vector<Source> random_sources() {
    std::vector<Source> sources{terrain("coarse", {300000, 200000, 50, 20, 20, 27700}, false, chance(2))};
    const std::vector<std::function<Source()>> kinds{
        [&] {
          return terrain("fine", {300305, 199855, 10, 40, 30, 27700}, false, chance(2));
        },
        [&] {
          return terrain("finer", {300500, 199700, 5, 70, 60, 27700}, true, chance(2));
        },
        [&] {
          return terrain("beyond", {300905, 199955, 10, 25, 60, 27700}, true, false);
        },
        [&] {
          return terrain("shifted", {300003, 199987, 50, 18, 18, 27700}, chance(2), false);
        },
        [&] { return lines(ThemeKind::Contours, "contours", random_lines(4, 150, std::round(in(90, 120))), false); },
        [&] { return lines(ThemeKind::Contours, "contours", random_lines(4, 150, std::round(in(90, 120))), false); },
        [&] {
          Source flat = lines(ThemeKind::Contours, "left flat", random_lines(2, 150, std::round(in(90, 120))), false);
          flat.options.repair = false;
          return flat;
        },
        [&] { return scattered(); },
        [&] { return lines(ThemeKind::Breaklines, "breaks", random_lines(5, 200), false); },
        [&] { return lines(ThemeKind::Breaklines, "breaks", random_lines(3, 300), false); },
        [&] { return lines(ThemeKind::Water, "water", random_boxes(2, 200), false); },
        [&] { return lines(ThemeKind::Roads, "roads", random_lines(6, 250), false); },
        [&] { return lines(ThemeKind::Walls, "outlines", random_boxes(4, 60), false); },
        [&] { return lines(ThemeKind::Buildings, "houses", random_boxes(8, 60), true); },
        [&] { return lines(ThemeKind::Buildings, "houses", random_boxes(8, 60), true); },
        [&] { return lines(ThemeKind::Buildings, "sheds", random_boxes(4, 20), true); },
        [&] { return lines(ThemeKind::Vegetation, "woods", random_boxes(3, 150), true); },
        [&] { return heights(ThemeKind::Vegetation); },
        [&] { return heights(ThemeKind::Surface); }};
    std::vector<std::size_t> chosen(kinds.size());
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
    std::shuffle(chosen.begin(), chosen.end(), random_);
    for (std::size_t i = 0, count = 2 + random_() % 4; i < count; ++i) sources.push_back(kinds[chosen[i]]());
    return sources;
  }

  void import(const std::string& store, const Source& source) {
    NoProgress progress;
    if (source.options.kind)
      import_lines(path(store), source.options, progress);
    else
      import_terrain(path(store), source.options, progress);
  }

  /// Lines but contours need ground to lie on.
  static bool may_come_first(const Source& source) {
    return !source.options.kind || source.options.kind == ThemeKind::Contours;
  }

  std::string import_all(const std::string& store, const std::vector<Source>& sources) {
    std::filesystem::remove(path(store));
    std::string order;
    for (const Source& source : sources) {
      order += (order.empty() ? "" : ", ") + source.what;
      import(store, source);
    }
    return order;
  }

  void expect_sound(const std::string& store) {
    NoProgress progress;
    for (const Damage& damage : check(Store(path(store)), progress))
      ADD_FAILURE() << damage.place << ": " << damage.what;
  }

  std::mt19937 random_{test::seed()};
  int files_ = 0;
  test::TemporaryDirectory directory_;
};

/// The case of the issue: houses cut lines of the ground, which lie over both grids.
TEST_F(ImportOrder, MakesNoDifferenceToHousesAndLinesOnRealGround) {
  const std::string data = std::string(ITIN_SOURCE_DIR) + "/scripts/demo-data/";
  ImportOptions ground, houses;
  ground.sources = {data + "alexandria-dtm.tif"};
  houses.sources = {data + "alexandria-buildings.geojson"};
  houses.kind = ThemeKind::Buildings;
  houses.theme = "houses";
  houses.height_field = "HEIGHT";
  std::vector<LineFeature> breaks;
  for (int i = 0; i < 25; ++i) {
    LineFeature f;
    Point3 p{in(321520, 322040), in(4297520, 4298000), in(5, 25)};
    for (int k = 0; k < 6; ++k, p = {p.x + in(-60, 60), p.y + in(-60, 60), in(5, 25)}) f.vertices.push_back(p);
    breaks.push_back(f);
  }
  Source lines_on_it = lines(ThemeKind::Breaklines, "breaks", breaks, false);
  lines_on_it.options.crs = "EPSG:26918";
  const Source coarse = terrain("coarse", {321498, 4298018, 20, 29, 26, 26918}, false, false);
  const std::vector<Source> sources{coarse, {"fine", ground}, lines_on_it, {"houses", houses}};
  import_all("first.itin", sources);
  expect_sound("first.itin");
  for (const std::vector<std::size_t>& order : {std::vector<std::size_t>{0, 1, 3, 2}, {1, 3, 2, 0}}) {
    std::vector<Source> other;
    for (const std::size_t i : order) other.push_back(sources[i]);
    SCOPED_TRACE(import_all("other.itin", other));
    expect_same_store(path("first.itin"), path("other.itin"));
  }
}

TEST_F(ImportOrder, MakesNoDifference) {
  for (int world = 0; world < 8; ++world) {
    std::vector<Source> sources = random_sources();
    const std::string first = import_all("first.itin", sources);
    expect_sound("first.itin");
    for (int turn = 0; turn < 2; ++turn) {
      do std::shuffle(sources.begin(), sources.end(), random_);
      while (!may_come_first(sources.front()));
      SCOPED_TRACE(first + " | " + import_all("other.itin", sources));
      expect_same_store(path("first.itin"), path("other.itin"));
    }
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace itin
