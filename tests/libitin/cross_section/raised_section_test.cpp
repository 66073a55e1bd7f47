// Cross-sections with buildings, vegetation and walls against the window's triangles cut by the line.
#include <array>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/import.hpp>
#include <itin/section_line.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "support/houses.hpp"
#include "support/impatient.hpp"
#include "support/raster_file.hpp"
#include "support/rolling_ground.hpp"
#include "support/section_text.hpp"
#include "support/seed.hpp"
#include "support/slow_section.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

using test::box;
using test::LineFeature;
using test::mirrored;
using test::text;

/// 60 x 60 posts every 10 m from (300000, 199400), and what tests put on them.
class RaisedSections : public testing::Test {
 protected:
  void ground(double (*height)(int, int)) {
    test::write_raster(path("t.tif"), {300000, 200000, 10, 60, 60, 27700}, height);
    ImportOptions options;
    options.sources = {path("t.tif")};
    NoProgress progress;
    import_terrain(path("s.itin"), options, progress);
  }
  void raise(ThemeKind kind, const std::string& theme, const std::vector<LineFeature>& features) {
    test::import_raised(path("s.itin"), path(theme + ".geojson"), kind, theme, features);
  }
  std::string path(const std::string& name) const { return directory_.file(name); }

  test::TemporaryDirectory directory_;
};

/// A window's triangles, to be cut by lines.
struct Whole {
  Whole(const Store& store, const Detail& detail, const ThemeChoice& choice) {
    NoProgress progress;
    const Tin tin = triangulate(store, Window::all(), detail, progress, choice);
    const auto theme = [&](std::uint32_t v) {
      return tin.raised_theme.empty() ? std::uint16_t{0} : tin.raised_theme[v];
    };
    const auto corner = [&](std::uint32_t v) { return test::ThemedPoint{tin.vertices[v], theme(v)}; };
    for (const auto& [a, b, c] : tin.triangles) triangles.push_back({corner(a), corner(b), corner(c)});
    for (std::uint32_t v = 0; v < tin.vertices.size(); ++v) {
      const Point3 p = tin.point(v);
      (theme(v) != 0 ? inner : other).push_back({p.x, p.y});
    }
  }
  CrossSection along(const Grid& grid, Point2 a, Point2 b) const {
    const SectionLine line(grid, a, b);
    const CrossSection section = test::slow_section(line, triangles);
    return line.is_mirrored() ? mirrored(section) : section;
  }

  std::vector<test::ThemedTriangle> triangles;
  std::vector<Point2> inner, other;  ///< vertices of features off their outlines, and the others
};

TEST_F(RaisedSections, EqualTheWindowsTrianglesCutByTheLine) {
  std::mt19937 random(test::seed());
  const auto in = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 100000) / 100000;
  };
  ground(test::rolling);
  std::vector<LineFeature> houses, woods, walls;
  for (int i = 0; i < 25; ++i) {  // they touch and overlap
    const double x = 300000 + std::round(in(2, 54)) * 10, y = 199400 + std::round(in(4, 54)) * 10;
    houses.push_back(box(x, y, x + in(2, 40), y + in(2, 40), in(2, 30)));
    houses.push_back(box(x + in(-9, 9), y - 12, x + 12, y, in(2, 30)));
  }
  for (int i = 0; i < 6; ++i) {
    const double x = in(300020, 300400), y = in(199420, 199800);
    woods.push_back(box(x, y, x + in(20, 150), y + in(20, 150), in(5, 20)));
  }
  for (int i = 0; i < 5; ++i) {
    const double x = in(300020, 300500), y = in(199420, 199950);
    walls.push_back(box(x, y, x + in(30, 80), y + 0.4, 1.8));
  }
  raise(ThemeKind::Vegetation, "woods", woods);
  raise(ThemeKind::Buildings, "houses", houses);
  raise(ThemeKind::Walls, "walls", walls);

  const Store store(path("s.itin"));
  const Grid& grid = store.metadata().grid;
  std::map<std::uint16_t, int> met;
  const std::vector<Detail> details{Detail::tolerance(0), Detail::tolerance(2), Detail::tolerance(32),
                                    Detail::rings({300290, 199700}, {{60, 0}, {150, 2}, {1000, 32}}),
                                    Detail::rings({300410, 199590}, {{40, 0}, {80, 8}, {120, 32}})};
  for (const ThemeChoice& choice :
       {ThemeChoice::all(), ThemeChoice::parse("houses"), ThemeChoice::parse("woods,walls"), ThemeChoice::none()}) {
    for (std::size_t d = 0; d < details.size(); ++d) {
      const Whole whole(store, details[d], choice);
      const SectionSurface surface(store, details[d], choice);
      const auto vertex = [&] {
        const std::vector<Point2>& from = whole.inner.empty() || random() % 2 == 0 ? whole.other : whole.inner;
        return from[random() % from.size()];
      };
      for (int i = 0; i < 60; ++i) {
        Point2 a{in(299990, 300600), in(199390, 200010)}, b{in(299990, 300600), in(199390, 200010)};
        if (i % 4 == 1) a = vertex();
        if (i % 4 == 2) a = vertex(), b = vertex();
        if (i % 12 == 3) a = vertex(), b = {a.x, b.y};  // along what runs due north
        if (i % 12 == 7) a = vertex(), b = {b.x, a.y};
        if (i % 12 == 11) b = a;
        SCOPED_TRACE(fmt::format("detail {}, from {},{} to {},{}", d, a.x, a.y, b.x, b.y));
        CrossSection expected = whole.along(grid, a, b);
        const CrossSection found = cross_section(store, a, b, details[d], choice);
        ASSERT_EQ(text(surface.between(a, b)), text(found));
        ASSERT_EQ(text(mirrored(cross_section(store, b, a, details[d], choice))), text(found));
        for (const Breakpoint& p : found.breakpoints) ++met[p.theme];
        ASSERT_EQ(text(found), text(expected));
      }
    }
  }
  EXPECT_GT(met[0], 1000);
  for (std::uint16_t theme = 1; theme <= 3; ++theme) EXPECT_GT(met[theme], theme == 3 ? 10 : 100) << theme;
}

double flat(int, int) {
  return 50;
}

TEST_F(RaisedSections, AHouseHasItsFootAndItsEavesAtEitherWall) {
  ground(flat);
  raise(ThemeKind::Buildings, "houses", {box(300102, 199702, 300142, 199732, 9)});
  const Store store(path("s.itin"));
  const CrossSection section =
      cross_section(store, {300095, 199715.3}, {300150, 199715.3}, Detail::tolerance(0), ThemeChoice::all());
  // The section meets each wall in order: foot, eaves, eaves, foot, and other points between them on roof and ground.
  std::vector<double> at_foot, at_eaves;
  for (const Breakpoint& p : section.breakpoints) {
    const bool within = p.distance > 7 && p.distance < 47;
    EXPECT_EQ(p.theme, within ? 1 : 0) << p.distance;
    if (p.position.z == 50) at_foot.push_back(p.distance);
    if (p.position.z == 59) at_eaves.push_back(p.distance);
    const bool in_wall = (p.distance > 7 && p.distance < 7.05) || (p.distance > 46.95 && p.distance < 47);
    EXPECT_TRUE(in_wall || p.position.z == 50 || p.position.z == 59) << p.distance;
  }
  EXPECT_NEAR(*std::find_if(at_foot.rbegin(), at_foot.rend(), [](double d) { return d < 8; }), 7, 1e-9);
  EXPECT_NEAR(*std::find_if(at_foot.begin(), at_foot.end(), [](double d) { return d > 8; }), 47, 1e-9);
  ASSERT_GE(at_eaves.size(), 2u);
  EXPECT_NEAR(at_eaves.front(), 7.05, 1e-9);
  EXPECT_NEAR(at_eaves.back(), 46.95, 1e-9);
}

// A place on their border is on both outlines, whichever way a line comes there.
TEST_F(RaisedSections, ABorderOfAHouseAndAWoodIsWithinNeither) {
  ground(flat);
  raise(ThemeKind::Vegetation, "woods", {box(300142, 199702, 300182, 199732, 12)});
  raise(ThemeKind::Buildings, "houses", {box(300102, 199702, 300142, 199732, 9)});
  const Store store(path("s.itin"));
  const auto themes_at = [&](Point2 place, Point2 from, Point2 to) {
    std::vector<int> themes;
    for (const Breakpoint& p : cross_section(store, from, to, Detail::tolerance(0), ThemeChoice::all()).breakpoints)
      if (std::hypot(p.position.x - place.x, p.position.y - place.y) < 1e-6) themes.push_back(p.theme);
    return themes;
  };
  const Point2 place{300142, 199715.31};
  const std::vector<int> neither{0};
  EXPECT_EQ(themes_at(place, {300120, place.y}, {300160, place.y}), neither) << "across the border";
  EXPECT_EQ(themes_at(place, {300120, place.y}, place), neither) << "to it";
  EXPECT_EQ(themes_at(place, place, {300160, place.y}), neither) << "from it";
  EXPECT_EQ(themes_at(place, {place.x, 199712}, place), neither) << "along it";
  EXPECT_EQ(themes_at(place, place, {place.x, 199718}), neither) << "along it, onwards";
  EXPECT_EQ(themes_at(place, place, place), neither) << "at it";
}

TEST_F(RaisedSections, FeaturesAreKnownByPlace) {
  ground(flat);
  raise(ThemeKind::Buildings, "houses",
        {box(300102, 199702, 300142, 199732, 9), box(300142, 199702, 300162, 199732, 5)});
  raise(ThemeKind::Vegetation, "woods", {box(300202, 199702, 300242, 199732, 9)});
  const Store store(path("s.itin"));
  const auto houses = features_at(store, 1, {{300103, 199703}, {300150, 199731.9}, {300102, 199710}, {300180, 199710}});
  ASSERT_EQ(houses.size(), 4u);
  ASSERT_TRUE(houses[0] && houses[1] && houses[2]);
  EXPECT_EQ(houses[0]->number, 0);
  EXPECT_EQ(houses[0]->name, "feature 0");
  EXPECT_EQ(houses[1]->number, 1);
  EXPECT_EQ(houses[2]->number, 0);
  EXPECT_FALSE(houses[3]);
  EXPECT_TRUE(features_at(store, 2, {{300210, 199710}}).front());
}

/// A tower stands on a podium: what is seen of them at a place is the higher of the two.
TEST_F(RaisedSections, FeaturesThatOverlapAreKnownByTheirTops) {
  ground(flat);
  std::mt19937 random(test::seed());
  const auto draw = [&](int most) { return static_cast<double>(random() % static_cast<unsigned>(most)); };
  std::vector<LineFeature> boxes;
  std::vector<std::array<double, 5>> sides;  // west, south, east, north, height
  for (int i = 0; i < 12; ++i) {
    const double west = 300105 + draw(120), south = 199605 + draw(120), height = 5 + 3 * i;
    sides.push_back({west, south, west + 30 + draw(60), south + 30 + draw(60), height});
  }
  std::shuffle(sides.begin(), sides.end(), random);
  for (const auto& [west, south, east, north, height] : sides) boxes.push_back(box(west, south, east, north, height));
  raise(ThemeKind::Buildings, "houses", boxes);
  const Store store(path("s.itin"));
  std::map<std::string, double> heights;
  for (std::size_t i = 0; i < sides.size(); ++i) heights["feature " + std::to_string(i)] = sides[i][4];
  std::vector<Point2> places;
  std::vector<double> expected;
  while (places.size() < 300) {
    const Point2 place{300100 + draw(2200) / 10, 199600 + draw(2200) / 10};
    double highest = 0;
    bool is_on_border = false;
    for (const auto& [west, south, east, north, height] : sides) {
      const double within = std::min({place.x - west, east - place.x, place.y - south, north - place.y});
      is_on_border = is_on_border || std::abs(within) < 1.5;
      if (within > 0) highest = std::max(highest, height);
    }
    if (!is_on_border) places.push_back(place), expected.push_back(highest);
  }
  const auto found = features_at(store, 1, places);
  const auto height_at = [&](const Point2& p) {
    return cross_section(store, p, {p.x + 0.5, p.y}, Detail::tolerance(0), ThemeChoice::all())
        .breakpoints[0]
        .position.z;
  };
  const double level = height_at({300050, 199650});
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(found[i] ? heights.at(found[i]->name) : 0, expected[i]) << i;
    EXPECT_NEAR(height_at(places[i]) - level, expected[i], 0.02) << i;
  }
}

TEST_F(RaisedSections, EndWhenTheyAreCancelled) {
  ground(flat);
  raise(ThemeKind::Buildings, "houses", {box(300102, 199702, 300142, 199732, 9)});
  const Store store(path("s.itin"));
  const auto cut = [&](const Progress& progress) {
    return cross_section(store, {300050, 199713}, {300250, 199721}, Detail::tolerance(0), ThemeChoice::all(), progress);
  };
  const test::Impatient patient(1 << 30);
  cut(patient);
  ASSERT_GT(patient.asked(), 20);  // for each triangle
  for (const int looks : {0, 10, patient.asked() - 1}) EXPECT_THROW(cut(test::Impatient(looks)), Cancelled) << looks;
  EXPECT_THROW(features_at(store, 1, {{300103, 199703}}, test::Impatient(0)), Cancelled);
}

TEST_F(RaisedSections, UnknownThemesAreRefused) {
  ground(flat);
  const Store store(path("s.itin"));
  const auto ask = [&] {
    return cross_section(store, {300100, 199700}, {300200, 199700}, Detail::tolerance(0), ThemeChoice::parse("moats"));
  };
  EXPECT_THROW(ask(), InputError);
  EXPECT_THROW(SectionSurface(store, Detail::tolerance(0), ThemeChoice::parse("moats")), InputError);
}

}  // namespace
}  // namespace itin
