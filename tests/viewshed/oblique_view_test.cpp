// Pictures of a box on a plain, from above and from the south.
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include <itin/error.hpp>
#include <viewshed/map_image.hpp>

#include "support/terrain_tin.hpp"

namespace itin {
namespace {

std::array<int, 3> pixel(const viewshed::MapImage& image, double across, double down) {
  const auto x = static_cast<std::size_t>(across * image.width), y = static_cast<std::size_t>(down * image.height);
  const std::size_t at = 3 * (y * static_cast<std::size_t>(image.width) + x);
  return {image.rgb.at(at), image.rgb.at(at + 1), image.rgb.at(at + 2)};
}

TEST(ObliqueView, ShowsAPlainFromAboveAsItLies) {
  const Tin plain = test::lattice_tin(21, 11, 10, [](auto, auto) { return 5.0; });
  const viewshed::MapImage image = viewshed::draw_oblique(plain, {0, 90, 400});
  EXPECT_EQ(image.width, 400);
  EXPECT_NEAR(image.height, 400 * (100 + 8.0) / 208, 2);
  const auto ground = pixel(image, 0.5, 0.5), paper = pixel(image, 0.003, 0.5);
  EXPECT_EQ(paper, (std::array{255, 255, 255}));
  for (const double x : {0.1, 0.4, 0.9})
    for (const double y : {0.1, 0.6, 0.9}) EXPECT_EQ(pixel(image, x, y), ground);
}

TEST(ObliqueView, HidesWhatIsBehindAWall) {
  // A ridge 40 m high runs across; from the south, 30 degrees up, it hides some of the ground north of it.
  const auto ridge = [](auto, auto r) { return r == 10 ? 40.0 : 0.0; };
  Tin tin = test::lattice_tin(21, 21, 10, ridge);
  tin.raised_theme.assign(tin.vertices.size(), 0);
  // Ground just north of the ridge is painted as a theme's.
  for (std::size_t v = 0; v < tin.vertices.size(); ++v) tin.raised_theme[v] = tin.vertices[v].y / 1000 == 12 ? 3 : 0;
  const auto colours = [](const viewshed::MapImage& image) {
    std::set<std::array<int, 3>> found;
    for (int y = 0; y < 200; ++y)
      for (int x = 60; x < 140; ++x) found.insert(pixel(image, x / 200.0, y / 200.0));
    return found;
  };
  EXPECT_GT(colours(viewshed::draw_oblique(tin, {0, 90, 400})).size(),
            colours(viewshed::draw_oblique(tin, {0, 20, 400})).size());
}

TEST(ObliqueView, HasAColourForEachKindOfTheme) {
  Tin tin = test::lattice_tin(5, 5, 10, [](auto, auto) { return 5.0; });
  tin.raised_theme.assign(tin.vertices.size(), 2);
  const auto drawn = [&](ThemeKind kind) {
    return pixel(viewshed::draw_oblique(tin, {.elevation = 90, .pixels = 400, .kinds = {ThemeKind::Water, kind}}), 0.5,
                 0.5);
  };
  const auto houses = drawn(ThemeKind::Buildings), woods = drawn(ThemeKind::Vegetation);
  EXPECT_GT(houses[0], houses[1]);
  EXPECT_GT(woods[1], woods[0]);
  EXPECT_EQ(drawn(ThemeKind::Terraces), houses);
}

TEST(ObliqueView, DrawsEdgesWhereTrianglesMeet) {
  // Triangles of 200 x 200 m: the middles of the squares' sides lie on edges, a quarter of a square away none is near.
  const Tin plain = test::lattice_tin(3, 2, 200, [](auto, auto) { return 5.0; });
  const viewshed::MapImage bare = viewshed::draw_oblique(plain, {0, 90, 400}),
                           mesh = viewshed::draw_oblique(plain, {0, 90, 400, true});
  ASSERT_EQ(mesh.rgb.size(), bare.rgb.size());
  std::size_t darker = 0;
  for (std::size_t i = 0; i < mesh.rgb.size(); ++i) {
    EXPECT_LE(mesh.rgb[i], bare.rgb[i]);
    darker += mesh.rgb[i] < bare.rgb[i] ? 1 : 0;
  }
  EXPECT_GT(darker, 0U);
  EXPECT_LT(darker, mesh.rgb.size() / 10);
  const auto on_edge = pixel(mesh, 0.5, 0.5), within = pixel(mesh, 0.25 + 0.02, 0.25);
  EXPECT_LT(on_edge[0], within[0]);
  EXPECT_EQ(within, pixel(bare, 0.25 + 0.02, 0.25));
}

TEST(ObliqueView, RefusesWhatCannotBeDrawn) {
  const Tin plain = test::lattice_tin(3, 3, 10, [](auto, auto) { return 5.0; });
  EXPECT_THROW(viewshed::draw_oblique(plain, {0, 0, 400}), InputError);
  EXPECT_THROW(viewshed::draw_oblique(plain, {0, 91, 400}), InputError);
  EXPECT_THROW(viewshed::draw_oblique(plain, {std::nan(""), 40, 400}), InputError);
  EXPECT_THROW(viewshed::draw_oblique(plain, {0, 40, 100}), InputError);
  EXPECT_THROW(viewshed::draw_oblique(Tin{}, {0, 40, 400}), InputError);
}

}  // namespace
}  // namespace itin
