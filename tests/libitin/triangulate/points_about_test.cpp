// How many points a window has, told from directories alone.
#include <cmath>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

TEST(PointsAbout, AreThoseOfTheWholeAndNoFewerThanThoseWithin) {
  const test::TemporaryDirectory directory;
  test::write_raster(directory.file("t.tif"), {300000, 200000, 10, 150, 150, 27700},
                     [](int c, int r) { return 20 * std::sin(c * 0.13) * std::cos(r * 0.09); });
  ImportOptions options;
  options.sources = {directory.file("t.tif")};
  options.tolerances = {1, 4};
  NoProgress progress;
  import_terrain(directory.file("s.itin"), options, progress);
  const Store store(directory.file("s.itin"));
  const Point2 centre{300700, 199300};
  const Window disc = Window::disc(centre, 150);
  for (const double tolerance : {0.0, 1.0, 4.0}) {
    const Detail detail = Detail::tolerance(tolerance);
    const std::size_t all = triangulate(store, Window::all(), detail, progress).vertices.size();
    EXPECT_EQ(points_about(store, Window::all(), detail), all);
    std::size_t within = 0;
    for (const GridPoint& v : triangulate(store, disc, detail, progress).vertices) {
      const Point3 p = store.metadata().grid.point(v);
      within += std::hypot(p.x - centre.x, p.y - centre.y) <= 150;
    }
    EXPECT_GE(points_about(store, disc, detail), within);
    if (tolerance == 0) {
      EXPECT_LT(points_about(store, disc, detail), all / 4);
    }
  }
  const Detail rings = Detail::rings(centre, {{150, 0}, {3000, 4}});
  EXPECT_LT(points_about(store, Window::all(), rings), points_about(store, Window::all(), Detail::tolerance(0)) / 2);
  EXPECT_THROW(points_about(store, disc, rings, ThemeChoice::parse("trees")), InputError);
}

}  // namespace
}  // namespace itin
