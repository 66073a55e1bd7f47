// Missing ground that is filled with the sea is as if the sources had had posts there.
#include <cmath>
#include <gmock/gmock.h>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/tin_heights.hpp>
#include <itin/triangulate.hpp>
#include <itin/verify.hpp>

#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

using test::RasterShape;

constexpr double kLevel = -0.5;
const RasterShape kWhole{300000, 200000, 50, 60, 40, 27700};

double land(double east, double north) {
  return 30 + 12 * std::sin(east / 300) + 9 * std::cos(north / 210);
}
bool is_bay(int c, int r) {
  return std::hypot(c - 12, r - 8) < 6 || (c == 3 && r == 30);
}

class Sea : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }

  /// Some columns of the whole; `sea` in the bay.
  void write(const std::string& name, int from, int to, double sea) const {
    RasterShape shape = kWhole;
    shape.xmin += from * shape.step, shape.columns = to - from;
    test::write_raster(path(name), shape, [&](int c, int r) { return height(c + from, r, sea); });
  }
  static double height(int c, int r, double sea) {
    return is_bay(c, r) ? sea : land(kWhole.xmin + (c + 0.5) * kWhole.step, kWhole.ymax - (r + 0.5) * kWhole.step);
  }
  ImportReport import(const std::string& store, const std::vector<std::string>& sources,
                      const ImportOptions& of = {}) const {
    ImportOptions options = of;
    for (const std::string& source : sources) options.sources.push_back(path(source));
    NoProgress progress;
    return import_terrain(path(store), options, progress);
  }
  Tin surface(const std::string& store, double tolerance = 0) const {
    NoProgress progress;
    return triangulate(Store(path(store)), Window::all(), Detail::tolerance(tolerance), progress);
  }
  void expect_same(const std::string& a, const std::string& b) const {
    for (const double tolerance : {0.0, 4.0}) {
      const Tin t = surface(a, tolerance), u = surface(b, tolerance);
      EXPECT_TRUE(t.vertices == u.vertices) << t.vertices.size() << " and " << u.vertices.size();
      EXPECT_TRUE(t.triangles == u.triangles);
    }
  }
  static ImportOptions with_sea(double level = kLevel) {
    ImportOptions options;
    options.sea_level = level;
    return options;
  }

  test::TemporaryDirectory directory_;
};

/// Tiles west and east of a channel that has none, and a bay: against one raster with the sea's posts in it.
TEST_F(Sea, IsAsIfTheSourcesHadPostsThere) {
  write("west.tif", 0, 20, NAN), write("east.tif", 40, 60, NAN);
  test::write_raster(path("all.tif"), kWhole,
                     [](int c, int r) { return c >= 20 && c < 40 ? kLevel : height(c, r, kLevel); });
  import("all.itin", {"all.tif"});
  import("sea.itin", {"west.tif", "east.tif"}, with_sea());
  import("turned.itin", {"east.tif", "west.tif"}, with_sea());
  expect_same("all.itin", "sea.itin");
  expect_same("all.itin", "turned.itin");
  const SourceInfo sea = Store(path("sea.itin")).metadata().sources.back();
  EXPECT_EQ(sea.kind, "sea");
  EXPECT_EQ(sea.path, "sea at -0.5 m");
  EXPECT_EQ(sea.spacing, 50);
  EXPECT_GT(sea.vertices, 800U);
}

TEST_F(Sea, OrderOfImportsMakesNoDifference) {
  write("west.tif", 0, 20, NAN), write("east.tif", 40, 60, NAN), write("middle.tif", 20, 40, NAN);
  import("one.itin", {"west.tif", "east.tif"}, with_sea());
  import("one.itin", {"middle.tif"});
  import("other.itin", {"middle.tif"});
  import("other.itin", {"east.tif", "west.tif"}, with_sea());
  expect_same("one.itin", "other.itin");
  NoProgress progress;
  EXPECT_TRUE(verify(Store(path("one.itin")), {}, progress).damage.empty());
}

/// On a lattice that is not the sea's, too.
TEST_F(Sea, GivesWayToAllGroundWithinItsCoverage) {
  write("west.tif", 0, 20, NAN), write("east.tif", 40, 60, NAN);
  const RasterShape island{301213, 199300, 20, 30, 30, 27700};
  test::write_raster(path("island.tif"), island, [](int c, int r) { return 10.0 + (7 * c + 3 * r) % 11; });
  import("sea.itin", {"west.tif", "east.tif"}, with_sea());
  import("sea.itin", {"island.tif"});
  const Tin tin = surface("sea.itin");
  const Box box{1213 + 300000 + 10, 199300 - 590, 301213 + 590, 199300 - 10};
  std::size_t within = 0;
  for (std::size_t v = 0; v < tin.vertices.size(); ++v) {
    const Point2 p = tin.grid.position(tin.vertices[v].x, tin.vertices[v].y);
    const bool inside = p.x >= box.xmin && p.x <= box.xmax && p.y >= box.ymin && p.y <= box.ymax;
    within += inside ? 1U : 0U;
    EXPECT_TRUE(!inside || tin.vertices[v].z * tin.grid.resolution >= 10) << p.x << ' ' << p.y;
  }
  EXPECT_EQ(within, 900U);
  // No hole is left about it.
  NoProgress progress;
  for (double x = box.xmin - 200; x < box.xmax + 200; x += 7)
    for (double y = box.ymin - 200; y < box.ymax + 200; y += 7) EXPECT_TRUE(height_on(tin, {x, y})) << x << ' ' << y;
}

TEST_F(Sea, StaysWithinItsArea) {
  write("west.tif", 0, 20, NAN);
  ImportOptions options = with_sea(0);
  options.sea_area = "POLYGON((300950 198500,302100 198500,302100 199500,300950 199500,300950 198500))";
  import("sea.itin", {"west.tif"}, options);
  const Tin tin = surface("sea.itin");
  std::size_t sea = 0;
  for (const GridPoint& p : tin.vertices) sea += p.z == 0 ? 1U : 0U;
  EXPECT_EQ(sea, 22U * 20U);  // from column 20 to 41, 20 rows
  EXPECT_TRUE(height_on(tin, {302050, 199000}));
  EXPECT_FALSE(height_on(tin, {302200, 199000}));
  EXPECT_FALSE(height_on(tin, {300620, 199600}));  // the bay
}

TEST_F(Sea, ThatFillsNothingIsTold) {
  write("land.tif", 20, 40, NAN);
  const ImportReport report = import("land.itin", {"land.tif"}, with_sea());
  EXPECT_EQ(report.sea, 0U);
  EXPECT_THAT(report.warnings, testing::Contains(testing::HasSubstr("`sea_level` filled nothing")));
  write("bay.tif", 0, 20, NAN);
  EXPECT_THAT(import("bay.itin", {"bay.tif"}, with_sea()).warnings, testing::IsEmpty());
}

TEST_F(Sea, WrongCalls) {
  write("west.tif", 0, 20, NAN);
  import("sea.itin", {"west.tif"}, with_sea(0));
  const auto error = [&](const std::string& store, const ImportOptions& options) -> std::string {
    try {
      import(store, {"west.tif"}, options);
      return "";
    } catch (const InputError& e) {
      return e.what();
    }
  };
  EXPECT_THAT(error("sea.itin", with_sea(1)), testing::HasSubstr("the store has the sea at 0 m already"));
  EXPECT_EQ(error("sea.itin", with_sea(0)), "");
  EXPECT_THAT(error("new.itin", with_sea(20000)), testing::HasSubstr("`sea_level` 20000"));
  ImportOptions area;
  area.sea_area = "POLYGON((0 0,1 0,1 1,0 0))";
  EXPECT_THAT(error("new.itin", area), testing::HasSubstr("`sea_area`: give `sea_level` with it"));
  area.sea_level = 0, area.sea_area = "POLYGON((-5e6 -5e6,5e6 -5e6,5e6 5e6,-5e6 5e6,-5e6 -5e6))";
  EXPECT_THAT(error("new.itin", area), testing::HasSubstr("beyond any store"));
}

}  // namespace
}  // namespace itin
