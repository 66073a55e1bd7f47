// Pictures from a place: where the horizon, a wall and a tower must stand in them.
#include <cmath>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <viewshed/map_image.hpp>

#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

constexpr double kDegree = 0.017453292519943295;

std::array<int, 3> pixel(const MapImage& image, double x, double y) {
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  return {image.rgb.at(at), image.rgb.at(at + 1), image.rgb.at(at + 2)};
}

bool is_sky(const std::array<int, 3>& colour) {
  return colour[2] > colour[0];
}

/// The first row of a column that is no sky.
int top_of(const MapImage& image, double x) {
  for (int y = 0; y < image.height; ++y)
    if (!is_sky(pixel(image, x, y))) return y;
  return image.height;
}

PerspectiveOptions from(const Tin& tin, double height) {
  const Box box = tin.bounds();
  return {.eye = {(box.xmin + box.xmax) / 2, box.ymin + 50, height}, .pixels = 800, .earth = Earth::flat()};
}

double focal(const MapImage& image, double field) {
  return image.width / 2.0 / std::tan(field / 2 * kDegree);
}

TEST(PerspectiveView, APlainEndsBelowTheHorizon) {
  const Tin plain = test::lattice_tin(101, 101, 50, [](auto, auto) { return 0.0; });
  PerspectiveOptions options = from(plain, 20);
  const double far = plain.bounds().ymax - options.eye.y;
  const MapImage image = draw_perspective(plain, options);
  EXPECT_EQ(image.width, 800);
  EXPECT_EQ(image.height, 450);
  EXPECT_NEAR(top_of(image, 400), 225 + focal(image, 60) * 20 / far, 1.5);
  options.pitch = 10;
  const MapImage upwards = draw_perspective(plain, options);
  EXPECT_NEAR(top_of(upwards, 400), 225 + focal(image, 60) * std::tan(std::atan(20 / far) + 10 * kDegree), 1.5);
}

TEST(PerspectiveView, TheEarthCurvesAway) {
  const Tin plain = test::lattice_tin(101, 101, 2000, [](auto, auto) { return 0.0; });
  PerspectiveOptions options = from(plain, 20);
  options.field = 2;
  options.earth = Earth();
  // The highest of a curved plain is at the eye's horizon, by which the ground has sunk as far as the eye is high.
  const double drop = options.earth.drop_coefficient(), distance = std::sqrt(20 / drop);
  const MapImage image = draw_perspective(plain, options);
  EXPECT_NEAR(top_of(image, 400), 225 + focal(image, 2) * 2 * 20 / distance, 12);  // edges of 2 km cut the curve
}

TEST(PerspectiveView, AWallHidesWhatIsBehindIt) {
  const auto wall = [](auto, auto r) { return r == 40 ? 60.0 : 0.0; };
  const Tin tin = test::lattice_tin(101, 101, 50, wall);
  const PerspectiveOptions options = from(tin, 20);
  // Rows count from one of the two sides; the wall's distance is found from its vertices.
  double distance = 0;
  for (std::uint32_t v = 0; v < tin.vertices.size(); ++v)
    if (tin.point(v).z > 0) distance = tin.point(v).y - options.eye.y;
  const MapImage image = draw_perspective(tin, options);
  EXPECT_NEAR(top_of(image, 400), 225 - focal(image, 60) * 40 / distance, 1.5);
}

TEST(PerspectiveView, LooksWhereItIsTold) {
  // A spire in the middle; seen from the south-west it is ahead at 45 degrees.
  const Tin tin = test::lattice_tin(101, 101, 50, [](auto c, auto r) { return c == 50 && r == 50 ? 500.0 : 0.0; });
  const Box box = tin.bounds();
  PerspectiveOptions options{.eye = {box.xmin + 500, box.ymin + 500, 20}, .pixels = 800, .earth = Earth::flat()};
  const auto highest_column = [&](double azimuth) {
    options.azimuth = azimuth;
    const MapImage image = draw_perspective(tin, options);
    int best = 0;
    for (int x = 1; x < image.width; ++x)
      if (top_of(image, x) < top_of(image, best)) best = x;
    return best;
  };
  EXPECT_NEAR(highest_column(45), 400, 1.5);
  const double right = 800 / 2.0 / std::tan(30 * kDegree) * std::tan(20 * kDegree);
  EXPECT_NEAR(highest_column(25), 400 + right, 2.5);
  EXPECT_NEAR(highest_column(65), 400 - right, 2.5);
}

TEST(PerspectiveView, GroundBehindTheEyeIsNotSeen) {
  const Tin plain = test::lattice_tin(21, 21, 50, [](auto, auto) { return 0.0; });
  PerspectiveOptions options = from(plain, 20);
  options.azimuth = 180, options.eye.z = 8;  // 50 m of ground before the edge
  const MapImage image = draw_perspective(plain, options);
  EXPECT_NEAR(top_of(image, 400), 225 + focal(image, 60) * 8 / 50, 1.5);
}

TEST(PerspectiveView, RefusesWhatCannotBeDrawn) {
  const Tin plain = test::lattice_tin(3, 3, 10, [](auto, auto) { return 5.0; });
  const auto refused = [&](auto change) {
    PerspectiveOptions options = from(plain, 20);
    change(options);
    EXPECT_THROW(draw_perspective(plain, options), InputError);
  };
  refused([](PerspectiveOptions& o) { o.pitch = 90; });
  refused([](PerspectiveOptions& o) { o.field = 0; });
  refused([](PerspectiveOptions& o) { o.field = 170; });
  refused([](PerspectiveOptions& o) { o.azimuth = std::nan(""); });
  refused([](PerspectiveOptions& o) { o.pixels = 100; });
  EXPECT_THROW(draw_perspective(Tin{}, {}), InputError);
}

}  // namespace
}  // namespace itin::viewshed
