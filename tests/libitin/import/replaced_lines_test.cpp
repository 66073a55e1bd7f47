// Lines with heights make room for finer ground that is imported with `replace`: within its coverage the surface is
// that of the finer ground alone, and beyond it no line is lost.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "geometry/cell.hpp"
#include "pyramid/points/sorted_points.hpp"
#include "pyramid/replacing_ground.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

using test::LineFeature;
using test::RasterShape;

const RasterShape kCoarse{300000, 200000, 50, 20, 20, 27700}, kFine{300300, 199700, 5, 80, 80, 27700};
/// Twenty steps within the coverage of the fine ground.
const Box kAwayFromTheSeam{300402.5, 199402.5, 300597.5, 199597.5};

class ReplacedLines : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  ImportReport import(const std::string& store, const ImportOptions& options) {
    NoProgress progress;
    return options.kind ? import_lines(path(store), options, progress) : import_terrain(path(store), options, progress);
  }

  ImportOptions terrain(const std::string& name, const RasterShape& shape, bool replace) {
    test::write_raster(path(name), shape, [&](int c, int r) {
      const double east = shape.xmin + c * shape.step, north = shape.ymax - r * shape.step;
      return 100 + 20 * std::sin(east / 170) + 15 * std::cos(north / 130) + 3 * std::sin(east / 23 + north / 31);
    });
    ImportOptions options;
    options.sources = {path(name)};
    options.replace = replace;
    return options;
  }

  ImportOptions lines(ThemeKind kind, const std::vector<LineFeature>& features) {
    const std::string file = path(std::string(name_of(kind)) + ".geojson");
    test::write_lines(file, features);
    ImportOptions options;
    options.sources = {file};
    options.kind = kind;
    if (kind == ThemeKind::Buildings) options.height_field = "h";
    return options;
  }

  std::vector<LineFeature> contours() {
    std::vector<LineFeature> features;
    for (int i = 0; i < 12; ++i) {
      const Point2 centre{in(300100, 300900), in(199100, 199900)};
      const double radius = in(20, 250), z = std::round(in(80, 130));
      LineFeature& f = features.emplace_back();
      for (int k = 0; k <= 60; ++k) {
        const double angle = 2 * std::numbers::pi * (k % 60) / 60;
        f.vertices.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle), z});
      }
    }
    return features;
  }

  std::vector<LineFeature> long_lines(int count, const Box& box) {
    std::vector<LineFeature> features;
    const auto end = [&] { return Point3{in(box.xmin, box.xmax), in(box.ymin, box.ymax), in(80, 130)}; };
    for (int i = 0; i < count; ++i) features.push_back({{end(), end()}});
    return features;
  }

  std::vector<LineFeature> houses() {
    std::vector<LineFeature> features;
    for (int i = 0; i < 12; ++i) {
      const double x = in(300305, 300660), y = in(199305, 199660);
      features.push_back(test::box(x, y, x + in(8, 30), y + in(8, 30), in(4, 20)));
    }
    return features;
  }

  Tin surface(const std::string& store, const ThemeChoice& themes, const Window& window = Window::all()) const {
    NoProgress progress;
    return triangulate(Store(path(store)), window, Detail::tolerance(0), progress, themes);
  }

  void expect_same_within(const std::string& a, const std::string& b, const ThemeChoice& themes) const {
    const Tin one = surface(a, themes, Window::box(kAwayFromTheSeam)),
              other = surface(b, themes, Window::box(kAwayFromTheSeam));
    ASSERT_FALSE(one.triangles.empty());
    EXPECT_TRUE(one.vertices == other.vertices) << one.vertices.size() << " and " << other.vertices.size();
    EXPECT_TRUE(one.triangles == other.triangles);
  }

  std::mt19937 random_{test::seed()};
  test::TemporaryDirectory directory_;
};

/// Roads and houses lie on the fine ground alone: beyond it they would be left out of one of the stores.
TEST_F(ReplacedLines, LeaveTheFinerGroundAsItIsAlone) {
  const ImportOptions coarse = terrain("coarse.tif", kCoarse, false), fine = terrain("fine.tif", kFine, true);
  const ImportOptions level = lines(ThemeKind::Contours, contours()),
                      breaks = lines(ThemeKind::Breaklines, long_lines(6, {300050, 199050, 300950, 199950})),
                      roads = lines(ThemeKind::Roads, long_lines(5, {300303, 199303, 300697, 199697})),
                      town = lines(ThemeKind::Buildings, houses());
  import("fine.itin", fine);
  for (const ImportOptions& options : {roads, town}) import("fine.itin", options);
  for (const ImportOptions& options : {coarse, level, breaks, fine, roads, town}) import("all.itin", options);
  for (const ThemeChoice& themes : {ThemeChoice::none(), ThemeChoice::all(), ThemeChoice::all().with_ground_lines()})
    expect_same_within("fine.itin", "all.itin", themes);
  // Contours alone are ground, too, and points are inferred between them.
  for (const ImportOptions& options : {level, fine}) import("contours.itin", options);
  expect_same_within("fine.itin", "contours.itin", ThemeChoice::none());
}

TEST_F(ReplacedLines, StayWhereTheyAreToldTo) {
  const LineFeature kerb{{{300450, 199450, 150}, {300550, 199550, 160}}};
  ImportOptions kerbs = lines(ThemeKind::Breaklines, {kerb});
  const ImportOptions fine = terrain("fine.tif", kFine, true);
  for (const bool stay : {false, true}) {
    const std::string store = stay ? "stay.itin" : "go.itin";
    kerbs.stay = stay;
    import(store, fine);
    const ImportReport report = import(store, kerbs);
    EXPECT_EQ(report.made_room, stay ? 0u : 1u);
    EXPECT_EQ(report.warnings.size(), stay ? 0u : 1u);
    const Store made(path(store));
    EXPECT_EQ(made.metadata().sources.back().makes_room, !stay);
    const Tin tin = surface(store, ThemeChoice::none());
    const auto on_the_kerb = std::count_if(tin.vertices.begin(), tin.vertices.end(), [&](const GridPoint& p) {
      return made.metadata().grid.position(p.x, p.y).x == 300450 && p.z == 15000;
    });
    EXPECT_EQ(on_the_kerb, stay ? 1 : 0);
  }
  import("alone.itin", fine);
  expect_same_within("alone.itin", "go.itin", ThemeChoice::none());
}

TEST_F(ReplacedLines, SayHowManyMadeRoomForTerrain) {
  import("a.itin", terrain("coarse.tif", kCoarse, false));
  import("a.itin", lines(ThemeKind::Breaklines, {{{ {300450, 199450, 90},
                                                    { 300550,
                                                      199550,
                                                      91 } }},
                                                 {{ {300100, 199450, 90},
                                                    { 300550,
                                                      199550,
                                                      91 } }},
                                                 {
                                                   { {300100, 199450, 90},
                                                     { 300150,
                                                       199850,
                                                       91 } }
                                                 }}));
  const ImportReport report = import("a.itin", terrain("fine.tif", kFine, true));
  EXPECT_EQ(report.made_room, 2u);
  EXPECT_TRUE(report.warnings.empty());
}

/// A line across the fine ground keeps both of its ends, up to the border of the outermost posts.
TEST_F(ReplacedLines, KeepWhatLiesBeyond) {
  import("a.itin", terrain("coarse.tif", kCoarse, false));
  import("a.itin", lines(ThemeKind::Breaklines, {{ { {300100, 199500, 90}, { 300900, 199500, 98 } } }}));
  import("a.itin", terrain("fine.tif", kFine, true));
  const Tin tin = surface("a.itin", ThemeChoice::none());
  std::vector<std::array<double, 3>> ends;
  for (const LineEdge& e : tin.lines)
    for (const std::uint32_t v : {e.from, e.to}) {
      const Point3 p = tin.point(v);
      if (p.y == 199500) ends.push_back({p.x, p.y, p.z});
    }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  const std::vector<std::array<double, 3>> expected{
      {300100, 199500, 90}, {300302.5, 199500, 92.03}, {300697.5, 199500, 95.98}, {300900, 199500, 98}};
  ASSERT_EQ(ends.size(), expected.size());
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(ends[i][k], expected[i][k], 1e-6) << i << " " << k;
}

/// The slow twin: whether a place lies on ground, by the squares of posts about it.
class GroundByHand {
 public:
  GroundByHand(int side, std::vector<bool> posts) : side_(side), posts_(std::move(posts)) {}
  bool at(double x, double y) const {
    const int c = static_cast<int>(std::floor(x / kStep)), r = static_cast<int>(std::floor(y / kStep));
    if (c < 0 || r < 0 || c + 1 >= side_ || r + 1 >= side_) return false;
    const double u = x / kStep - c, v = y / kStep - r;
    const std::array corners{post(c, r), post(c + 1, r), post(c, r + 1), post(c + 1, r + 1)};
    const auto present = std::count(corners.begin(), corners.end(), true);
    if (present != 3) return present == 4;
    if (!corners[0]) return u + v >= 1;
    if (!corners[3]) return u + v <= 1;
    return corners[1] ? u >= v : v >= u;
  }
  static constexpr int kStep = 100;

 private:
  bool post(int c, int r) const { return posts_[static_cast<std::size_t>(r * side_ + c)]; }
  int side_;
  std::vector<bool> posts_;
};

TEST_F(ReplacedLines, AreCutAtTheBorderOfTheGround) {
  constexpr int kSide = 24, kStep = GroundByHand::kStep;
  NoProgress progress;
  std::vector<bool> posts;
  PointSorter sorter(directory_.path(), 1 << 20);
  for (int r = 0; r < kSide; ++r) {
    for (int c = 0; c < kSide; ++c) {
      posts.push_back(random_() % 8 != 0);
      if (posts.back()) sorter.add({morton(c * kStep, r * kStep), 0, 0, 0});
    }
  }
  SourceInfo source;
  source.gap_basis = {1.5 * kStep, 0, 0, 1.5 * kStep};
  Grid grid;
  grid.resolution = 1;
  const std::array rank{SourceRank{}};
  const ReplacingGround ground(sorter.finish(rank, progress), {source}, grid, progress);
  const GroundByHand twin(kSide, posts);
  const auto end = [&] { return static_cast<std::int32_t>(random_() % (kSide * kStep + 400)) - 200; };
  int inside = 0, outside = 0;
  for (int i = 0; i < 400; ++i) {
    // Every fourth one along a row of posts, or through posts.
    const auto snapped = [&](std::int32_t v) { return i % 4 == 0 ? v / kStep * kStep : v; };
    const GridPoint a{snapped(end()), snapped(end()), 1000}, b{snapped(end()), snapped(end()), 3000};
    const std::vector<ReplacingGround::Piece> pieces = ground.outside(a, b);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (length == 0) continue;
    const auto along = [&](const GridPoint& p) { return std::hypot(p.x - a.x, p.y - a.y) / length; };
    for (const auto& [from, to] : pieces) {
      EXPECT_LT(along(from), along(to));
      for (const GridPoint& p : {from, to}) EXPECT_NEAR(p.z, 1000 + 2000 * along(p), 1 + 2000 / length);
    }
    for (int k = 0; k < 200; ++k) {
      const double t = (k + 0.5) / 200, x = a.x + t * (b.x - a.x), y = a.y + t * (b.y - a.y);
      // Places within two units of the border are either's.
      bool near = false;
      for (const double dx : {-2.0, 0.0, 2.0})
        for (const double dy : {-2.0, 0.0, 2.0}) near = near || twin.at(x + dx, y + dy) != twin.at(x, y);
      if (near) continue;
      const bool kept = std::any_of(pieces.begin(), pieces.end(), [&](const ReplacingGround::Piece& piece) {
        return along(piece.first) <= t && t <= along(piece.second);
      });
      EXPECT_EQ(kept, !twin.at(x, y)) << x << " " << y;
      (kept ? outside : inside) += 1;
    }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 1000);
}

}  // namespace
}  // namespace itin
