#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/geodesic.hpp>
#include <itin/grid_scale.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>

#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
namespace {

Box about(Point2 p, double half = 0) {
  return {p.x - half, p.y - half, p.x + half, p.y + half};
}

GridScale scale(const std::string& crs, const Box& area) {
  return grid_scale(crs, area).value();
}

// Snyder, Map Projections (USGS 1395), 4-20 and 4-18: the radii of curvature across and along a meridian, with which
// spherical Mercator and the plate carree have their scales in closed form.
TEST(GridScale, HasTheScalesOfTextbooks) {
  const GridScale meridian = scale("EPSG:32630", about({500000, 5000000}));
  EXPECT_NEAR(meridian.least, 0.9996, 2e-6);
  EXPECT_NEAR(meridian.greatest, 0.9996, 2e-6);
  for (const double latitude : {-60.0, 0.0, 20.0, 51.5, 80.0}) {
    const double phi = latitude * std::numbers::pi / 180, f = kWgs84.flattening, e2 = f * (2 - f);
    const double w = 1 - e2 * std::sin(phi) * std::sin(phi), a = kWgs84.major_m;
    const double across = a / std::sqrt(w), along = a * (1 - e2) / std::pow(w, 1.5);
    const auto at = [&](const char* crs) {
      return scale(crs, about(CoordinateTransform("EPSG:4326", crs)({10, latitude})));
    };
    const GridScale web = at("EPSG:3857");
    EXPECT_NEAR(web.greatest * along * std::cos(phi) / a, 1, 1e-6);
    EXPECT_NEAR(web.least * across * std::cos(phi) / a, 1, 1e-6);
    // At the equator the meridian's scale is the greater one.
    if (latitude == 0) continue;
    EXPECT_NEAR(at("EPSG:4087").greatest * across * std::cos(phi) / a, 1, 1e-6);
  }
}

TEST(GridScale, CoversAnAreaAndEveryDirection) {
  const GridScale zone = scale("EPSG:32631", {166000, 1000, 834000, 2000});
  EXPECT_NEAR(zone.least, 0.9996, 2e-6);
  EXPECT_NEAR(zone.greatest, 1.00098, 2e-5);
  // Equal areas: as much too long in one direction as too short in another.
  const GridScale area = scale("EPSG:3035", about({3000000, 2000000}));
  EXPECT_NEAR(area.least * area.greatest, 1, 1e-5);
  EXPECT_GT(area.greatest, 1.009);
}

TEST(GridScale, TakesPolesAndOtherBodies) {
  EXPECT_NEAR(scale("EPSG:3031", about({0, 0})).greatest, 0.97276, 2e-4);
  EXPECT_NEAR(scale("+proj=laea +lat_0=20 +lon_0=30 +R=1737400 +units=m", about({0, 0})).error(), 0, 2e-6);
}

TEST(GridScale, IsNoneWhereThereIsNoGround) {
  EXPECT_FALSE(grid_scale("EPSG:3035", about({9e7, 9e7})));
  // Transverse Mercator and Mercator go round the world again; nothing lies there.
  EXPECT_FALSE(grid_scale("EPSG:27700", about({300000, 1e9})));
  EXPECT_FALSE(grid_scale("EPSG:32630", about({300000, 2e7})));
  EXPECT_FALSE(grid_scale("EPSG:3857", about({6e7, 0})));
  EXPECT_TRUE(grid_scale("EPSG:27700", about({300000, 180000})));
  EXPECT_THROW(grid_scale("EPSG:4326", about({0, 0})), InputError);
  EXPECT_THROW(grid_scale("EPSG:2229", about({0, 0})), InputError);
}

TEST(GridScale, SaysTheErrorInWords) {
  EXPECT_EQ(error_in_words({1.6, 1.604}), "up to 60.4 % too long");
  EXPECT_EQ(error_in_words({0.99, 1.0012}), "up to 1.00 % too short");
}

/// A store knows its scale, so that no question about it has to ask PROJ.
TEST(GridScale, IsKeptWithAStoreAndMeasuredAgainAsItGrows) {
  const test::TemporaryDirectory directory;
  const auto import = [&](const char* name, double xmin) {
    test::write_raster(directory.file(name), {.xmin = xmin, .columns = 10, .rows = 10}, [](int, int) { return 10.0; });
    ImportOptions options;
    options.sources = {directory.file(name)};
    NoProgress progress;
    import_terrain(directory.file("s.itin"), options, progress);
    return Store(directory.file("s.itin")).metadata();
  };
  const StoreMetadata first = import("a.tif", 300000), second = import("b.tif", 600000);
  for (const StoreMetadata& m : {first, second}) {
    const GridScale expected = scale("EPSG:27700", m.grid.box(m.bounds));
    ASSERT_TRUE(m.scale);
    EXPECT_NEAR(m.scale->least, expected.least, 1e-9);
    EXPECT_NEAR(m.scale->greatest, expected.greatest, 1e-9);
    EXPECT_EQ(m.scale->allowed, kGreatestScaleError);
  }
  EXPECT_GT(second.scale->greatest - first.scale->greatest, 1e-5);
}

/// Lines some kilometres long, anywhere in a zone: what the scale says of the box about them holds.
TEST(GridScale, BoundsDistances) {
  std::mt19937 random(test::seed());
  for (int i = 0; i < 200; ++i) {
    const int zone = std::uniform_int_distribution(1, 60)(random);
    const std::string crs = "EPSG:" + std::to_string(32600 + zone);
    const Point2 a{std::uniform_real_distribution(200000.0, 800000.0)(random),
                   std::uniform_real_distribution(100000.0, 9000000.0)(random)};
    std::uniform_real_distribution<double> away(-9000, 9000);
    const Point2 b{a.x + away(random), a.y + away(random)};
    const CoordinateTransform to_geographic(crs, "EPSG:4326");
    const double ground = geodesic(to_geographic(a), to_geographic(b)).distance_m;
    const double ratio = std::hypot(a.x - b.x, a.y - b.y) / ground;
    Box box = about(a);
    box.extend(b);
    const GridScale found = scale(crs, box);
    EXPECT_GE(ratio, found.least - 2e-6);
    EXPECT_LE(ratio, found.greatest + 2e-6);
    EXPECT_LE(found.error(), 0.002);
  }
}

}  // namespace
}  // namespace itin
