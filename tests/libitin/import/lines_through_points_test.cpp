// A line through points of the ground keeps its own heights: it is the line that has a vertex at each of these points.
#include <algorithm>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>
#include <itin/verify.hpp>

#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

using test::LineFeature;
using test::RasterShape;

constexpr double kPostStep = 10, kWestmost = 300000, kNorthmost = 200000;
constexpr int kPostsInRow = 40;

/// A place among the posts.
struct Post {
  int column, row;
};

class LinesThroughPoints : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }
  int number(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }

  void import(const std::string& store, const ImportOptions& options) {
    NoProgress progress;
    options.kind ? import_lines(path(store), options, progress) : import_terrain(path(store), options, progress);
  }

  ImportOptions posts() {
    test::write_raster(
        path("posts.tif"),
        {kWestmost - kPostStep / 2, kNorthmost + kPostStep / 2, kPostStep, kPostsInRow, kPostsInRow, 27700},
        [&](int, int) { return 50 + number(200) / 100.0; });
    ImportOptions options;
    options.sources = {path("posts.tif")};
    return options;
  }

  ImportOptions lines(const std::string& name, ThemeKind kind, const std::vector<LineFeature>& features) {
    test::write_lines(path(name), features);
    ImportOptions options;
    options.sources = {path(name)};
    options.kind = kind;
    options.repair = kind != ThemeKind::Contours;
    return options;
  }

  static Point3 at(const Post& post, double z) {
    return {kWestmost + post.column * kPostStep, kNorthmost - post.row * kPostStep, z};
  }

  /// The line from post to post with a vertex at each post on its way, each `rise` higher than the one before.
  static LineFeature stepwise(const Post& from, const Post& to, double z, double rise) {
    const int steps = std::gcd(to.column - from.column, to.row - from.row);
    LineFeature line;
    for (int i = 0; i <= steps; ++i)
      line.vertices.push_back(at({from.column + (to.column - from.column) / std::max(steps, 1) * i,
                                  from.row + (to.row - from.row) / std::max(steps, 1) * i},
                                 z + i * rise));
    return line;
  }

  static LineFeature straight(const LineFeature& line) { return {{line.vertices.front(), line.vertices.back()}}; }

  Tin surface(const std::string& store, double tolerance) const {
    NoProgress progress;
    return triangulate(Store(path(store)), Window::all(), Detail::tolerance(tolerance), progress,
                       ThemeChoice::all().with_ground_lines());
  }

  void expect_same_surface(const std::string& a, const std::string& b) const {
    for (const double tolerance : {0.0, 0.5, 4.0}) {
      const Tin one = surface(a, tolerance), other = surface(b, tolerance);
      EXPECT_TRUE(one.vertices == other.vertices) << one.vertices.size() << " and " << other.vertices.size();
      EXPECT_TRUE(one.triangles == other.triangles) << "at " << tolerance << ", seed " << test::seed();
      EXPECT_TRUE(one.lines == other.lines) << "at " << tolerance;
    }
  }

  void expect_sound(const std::string& store) const {
    NoProgress progress;
    EXPECT_TRUE(verify(Store(path(store)), {}, progress).damage.empty()) << store << ", seed " << test::seed();
  }

  std::optional<double> height(const std::string& store, Point2 place) const {
    NoProgress progress;
    return heights_at(Store(path(store)), {place}, Detail::tolerance(0), ThemeChoice::none(), progress).front();
  }

  std::mt19937 random_{test::seed()};
  test::TemporaryDirectory directory_;
};

/// All lines lie in one plane, so that they agree where they cross.
TEST_F(LinesThroughPoints, AreThoseWithAVertexAtEachPoint) {
  for (const ThemeKind kind : {ThemeKind::Breaklines, ThemeKind::Contours, ThemeKind::Water}) {
    const double east = kind == ThemeKind::Contours ? 0 : 0.11, south = kind == ThemeKind::Contours ? 0 : -0.27;
    std::vector<LineFeature> with_vertices, without;
    for (int i = 0; i < 12; ++i) {
      const Post from{number(kPostsInRow), number(kPostsInRow)};
      Post to = from;
      while (to.column == from.column && to.row == from.row) {
        if (i % 3 != 0) to.column = number(kPostsInRow);
        if (i % 3 != 1) to.row = number(kPostsInRow);
      }
      const int steps = std::gcd(to.column - from.column, to.row - from.row);
      const double rise = east * (to.column - from.column) / steps + south * (to.row - from.row) / steps;
      with_vertices.push_back(stepwise(from, to, 60 + east * from.column + south * from.row, rise));
      without.push_back(straight(with_vertices.back()));
    }
    const std::string name(name_of(kind)), a = name + "-a.itin", b = name + "-b.itin";
    const ImportOptions ground = posts();
    for (const std::string& store : {a, b}) import(store, ground);
    import(a, lines(name + "-with.geojson", kind, with_vertices));
    import(b, lines(name + "-without.geojson", kind, without));
    const Tin one = surface(a, 0), other = surface(b, 0);
    ASSERT_EQ(one.vertices.size(), other.vertices.size()) << name << ", seed " << test::seed();
    for (std::size_t v = 0; v < one.vertices.size(); ++v) {
      EXPECT_EQ(one.vertices[v].x, other.vertices[v].x);
      EXPECT_EQ(one.vertices[v].y, other.vertices[v].y);
      EXPECT_NEAR(one.vertices[v].z, other.vertices[v].z, 1) << "rounding of crossings off the posts";
    }
    EXPECT_TRUE(one.triangles == other.triangles) << name << ", seed " << test::seed();
    expect_sound(b);
  }
}

TEST_F(LinesThroughPoints, KeepTheirHeightsOverARowOfPosts) {
  const ImportOptions ground = posts();
  for (const char* store : {"a.itin", "b.itin"}) import(store, ground);
  const LineFeature bank = stepwise({3, 20}, {35, 20}, 60, 0), diagonal = stepwise({2, 2}, {18, 18}, 40, 0.25),
                    steep = stepwise({5, 39}, {15, 24}, 70, -1);
  import("a.itin", lines("with.geojson", ThemeKind::Breaklines, {bank, diagonal, steep}));
  import("b.itin",
         lines("without.geojson", ThemeKind::Breaklines, {straight(bank), straight(diagonal), straight(steep)}));
  expect_same_surface("a.itin", "b.itin");
  for (double x = kWestmost + 35; x < kWestmost + 340; x += 5)
    EXPECT_EQ(height("b.itin", {x, kNorthmost - 200}), 60) << x;
}

TEST_F(LinesThroughPoints, MayBeImportedFirst) {
  const ImportOptions ground = posts();
  const ImportOptions contours =
      lines("contours.geojson", ThemeKind::Contours,
            {straight(stepwise({3, 20}, {35, 20}, 60, 0)), straight(stepwise({3, 26}, {35, 30}, 55, 0))});
  import("a.itin", ground);
  import("a.itin", contours);
  import("b.itin", contours);
  import("b.itin", ground);
  expect_same_surface("a.itin", "b.itin");
}

TEST_F(LinesThroughPoints, KeepTheirHeightsAtASingleScatteredPoint) {
  ImportOptions point;
  point.sources = {
      directory_.write("point.csv", "x,y,z\n300100.5,199799.5,50\n300205,199695,48\n300100.5,199790,51\n")};
  point.crs = "EPSG:27700";
  point.max_gap = 500;
  import("a.itin", posts());
  import("a.itin", point);
  import("a.itin", lines("dyke.geojson", ThemeKind::Breaklines, {{
                           { {300050.5, 199849.5, 60},
                             { 300150.5,
                               199749.5,
                               62 } }
                         }}));
  EXPECT_EQ(height("a.itin", {300100.5, 199799.5}), 61);
  expect_sound("a.itin");
}

}  // namespace
}  // namespace itin
