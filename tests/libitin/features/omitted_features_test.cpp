// The surface without some features, against an import without them, against the bare ground, and against itself in
// other windows and along lines.
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <itin/cross_section.hpp>
#include <itin/error.hpp>
#include <itin/feature_at.hpp>
#include <itin/import.hpp>
#include <itin/section_line.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "support/houses.hpp"
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

/// How far a surface may lie beside another that should equal it: vertices are on a grid of 1 cm, on slopes below 1
/// in 2.
constexpr double kOnGrid = 0.03;

struct Standing {
  ThemeKind kind;
  std::string theme;
  std::vector<LineFeature> features;
};

/// 60 x 60 posts every 10 m from (300000, 199400), and what stands on them.
class OmittedFeatures : public testing::Test {
 protected:
  std::string import(const std::string& name, const std::vector<Standing>& themes) {
    const std::string store = directory_.file(name);
    test::write_raster(directory_.file("t.tif"), {300000, 200000, 10, 60, 60, 27700}, test::rolling);
    ImportOptions options;
    options.sources = {directory_.file("t.tif")};
    NoProgress progress;
    import_terrain(store, options, progress);
    for (const Standing& theme : themes)
      if (!theme.features.empty())
        test::import_raised(store, directory_.file(theme.theme + ".geojson"), theme.kind, theme.theme, theme.features);
    return store;
  }

  double in(double low, double high) { return low + (high - low) * static_cast<double>(random_() % 100000) / 100000; }
  Point2 place() { return {in(300006, 300584), in(199416, 199994)}; }

  /// Houses in rows that share their walls, woods that houses and walls stand in, and single ones.
  std::vector<Standing> town() {
    std::vector<LineFeature> houses, woods, walls;
    for (int row = 0; row < 6; ++row) {
      double x = 300020 + in(0, 60);
      const double y = 199440 + 80 * row + in(0, 20), depth = in(6, 14);
      for (int i = 0; i < 6; ++i) {
        const double width = std::round(in(500, 2000)) / 100;
        houses.push_back(box(x, y, x + width, y + depth, in(3, 12)));
        x += width + (i == 3 ? 5 : 0);
      }
      walls.push_back(box(x + 10, y, x + 10 + in(20, 60), y + 0.4, 1.8));
      // Two woods side by side, neither of which need be the higher one everywhere.
      const double w = 300300 + in(0, 40), v = 199430 + 85 * row, border = w + in(40, 120), end = v + in(30, 70);
      woods.push_back(box(w, v, border, end, in(5, 20)));
      woods.push_back(box(border, v, border + in(10, 60), end - in(0, 20), in(5, 20)));
      houses.push_back(test::turned_box({w + 20, v + 15}, 8, 6, in(0, 3), in(3, 9)));
    }
    return {{ThemeKind::Vegetation, "woods", woods},
            {ThemeKind::Buildings, "houses", houses},
            {ThemeKind::Walls, "walls", walls}};
  }

  std::vector<double> heights(const Store& store, const std::vector<Point2>& places, const ThemeChoice& themes,
                              double tolerance = 0) {
    std::vector<double> metres;
    for (const auto& z : heights_at(store, places, Detail::tolerance(tolerance), themes, progress_))
      metres.push_back(z.value());
    return metres;
  }

  /// Every feature of the theme but each third one.
  static std::vector<FeatureNumber> some(const Store& store, std::uint16_t theme, int every = 3) {
    std::vector<FeatureNumber> numbers;
    for (const FeatureAt& f : features_of(store, theme))
      if (f.number % every == 0) numbers.push_back({theme, f.number});
    return numbers;
  }

  const test::TemporaryDirectory directory_;
  std::mt19937 random_{test::seed()};
  NoProgress progress_;
};

std::uint16_t theme_named_in(const Store& store, const std::string& name) {
  const auto& themes = store.metadata().themes;
  for (std::size_t t = 0; t < themes.size(); ++t)
    if (themes[t].name == name) return static_cast<std::uint16_t>(t + 1);
  throw Error("no theme " + name);
}

/// The distance to the outline, and whether the place lies within.
std::pair<double, bool> outline_beside(const LineFeature& feature, Point2 p) {
  double nearest = INFINITY;
  bool inside = false;
  for (std::size_t i = 0; i + 1 < feature.vertices.size(); ++i) {
    const Point3 a = feature.vertices[i], b = feature.vertices[i + 1];
    const double ux = b.x - a.x, uy = b.y - a.y;
    const double t = std::clamp(((p.x - a.x) * ux + (p.y - a.y) * uy) / (ux * ux + uy * uy), 0.0, 1.0);
    nearest = std::min(nearest, std::hypot(p.x - a.x - t * ux, p.y - a.y - t * uy));
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return {nearest, inside};
}

TEST_F(OmittedFeatures, EqualAnImportWithoutThem) {
  const std::vector<Standing> all = town();
  const Store store(import("all.itin", all));
  std::vector<Standing> rest = all;
  std::vector<FeatureNumber> numbers;
  std::vector<LineFeature> gone, there;
  for (Standing& theme : rest) {
    const std::uint16_t number = theme_named_in(store, theme.theme);
    std::vector<LineFeature> kept;
    for (std::size_t i = 0; i < theme.features.size(); ++i) {
      const bool omitted = random_() % 3 == 0;
      (omitted ? gone : there).push_back(theme.features[i]);
      if (omitted) numbers.push_back({number, static_cast<std::int64_t>(i)});
      if (!omitted) kept.push_back(theme.features[i]);
    }
    theme.features = kept;
  }
  const Store twin(import("rest.itin", rest));
  const ThemeChoice without = without_features(store, ThemeChoice::all(), numbers, progress_);
  EXPECT_EQ(without.omitted().size(), numbers.size());

  std::vector<Point2> places;
  for (int i = 0; i < 20000; ++i) places.push_back(place());
  for (const LineFeature& f : gone)  // dense where features were
    for (int i = 0; i < 300; ++i)
      places.push_back({in(f.vertices[0].x - 1, f.vertices[2].x + 1), in(f.vertices[0].y - 1, f.vertices[2].y + 1)});
  const std::vector<double> now = heights(store, places, without), before = heights(store, places, ThemeChoice::all()),
                            bare = heights(store, places, ThemeChoice::none()),
                            expected = heights(twin, places, ThemeChoice::all());
  int of_gone = 0, compared = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto near = [&](const LineFeature& f) { return outline_beside(f, places[i]).first < 0.3; };
    const auto within = [&](const LineFeature& f) { return outline_beside(f, places[i]).second; };
    const bool was = std::any_of(gone.begin(), gone.end(), within),
               is = std::any_of(there.begin(), there.end(), within);
    ASSERT_LE(now[i], before[i] + kOnGrid) << places[i].x << ' ' << places[i].y;
    ASSERT_GE(now[i], bare[i] - kOnGrid) << places[i].x << ' ' << places[i].y;
    if (std::any_of(there.begin(), there.end(), near) || std::any_of(gone.begin(), gone.end(), near)) continue;
    // Nothing changes beside them, and what makes way for them does not come back with the ground.
    const bool clearing = was && is && std::abs(now[i] - expected[i]) > kOnGrid;
    const double wanted = !was ? before[i] : clearing ? bare[i] : expected[i];
    ASSERT_NEAR(now[i], wanted, kOnGrid) << places[i].x << ' ' << places[i].y;
    ++compared;
    of_gone += was ? 1 : 0;
  }
  EXPECT_GT(of_gone, 1000);
  EXPECT_GT(compared, 10000);
}

TEST_F(OmittedFeatures, LeaveTheBareGroundWhereNoneIsLeft) {
  const Store store(import("all.itin", town()));
  std::vector<FeatureNumber> numbers;
  for (const char* theme : {"woods", "houses", "walls"})
    for (const FeatureNumber& n : some(store, theme_named_in(store, theme), 1)) numbers.push_back(n);
  const ThemeChoice without = without_features(store, ThemeChoice::all(), numbers, progress_);
  std::vector<Point2> places;
  for (int i = 0; i < 40000; ++i) places.push_back(place());
  const std::vector<double> now = heights(store, places, without), bare = heights(store, places, ThemeChoice::none());
  for (std::size_t i = 0; i < places.size(); ++i)
    ASSERT_NEAR(now[i], bare[i], kOnGrid) << places[i].x << ' ' << places[i].y;
}

TEST_F(OmittedFeatures, GiveWindowsThatEqualTheWhole) {
  const Store store(import("all.itin", town()));
  std::vector<FeatureNumber> numbers = some(store, theme_named_in(store, "houses"));
  for (const FeatureNumber& n : some(store, theme_named_in(store, "woods"))) numbers.push_back(n);
  for (const double tolerance : {0.0, 2.0, 8.0}) {
    const Detail detail = Detail::tolerance(tolerance);
    // Each choice finds the ground anew.
    const auto choice = [&] { return without_features(store, ThemeChoice::all(), numbers, progress_); };
    const Tin whole = triangulate(store, Window::all(), detail, progress_, choice());
    const auto corners_of = [](const Tin& tin) {
      std::set<std::array<GridPoint, 3>> all;
      for (std::uint32_t t = 0; t < tin.triangles.size(); ++t) all.insert(tin.corners(t));
      return all;
    };
    const auto all = corners_of(whole);
    std::set<std::array<GridPoint, 3>> seen;
    for (int column = 0; column < 6; ++column) {
      for (int row = 0; row < 6; ++row) {
        const double x = 300000 + 100 * column, y = 199400 + 100 * row;
        const Tin part = triangulate(store, Window::box({x, y, x + 100, y + 100}), detail, progress_, choice());
        for (const auto& t : corners_of(part)) {
          ASSERT_TRUE(all.contains(t)) << "tolerance " << tolerance;
          seen.insert(t);
        }
      }
    }
    EXPECT_EQ(seen.size(), all.size());
  }
}

TEST_F(OmittedFeatures, GiveSectionsThatEqualTheTriangles) {
  const Store store(import("all.itin", town()));
  std::vector<FeatureNumber> numbers = some(store, theme_named_in(store, "houses"), 2);
  for (const FeatureNumber& n : some(store, theme_named_in(store, "woods"), 2)) numbers.push_back(n);
  const ThemeChoice without = without_features(store, ThemeChoice::all(), numbers, progress_);
  for (const double tolerance : {0.0, 4.0}) {
    const Detail detail = Detail::tolerance(tolerance);
    const Tin tin = triangulate(store, Window::all(), detail, progress_, without);
    std::vector<test::ThemedTriangle> triangles;
    const auto corner = [&](std::uint32_t v) {
      return test::ThemedPoint{tin.vertices[v], tin.raised_theme.empty() ? std::uint16_t{0} : tin.raised_theme[v]};
    };
    for (const auto& [a, b, c] : tin.triangles) triangles.push_back({corner(a), corner(b), corner(c)});
    const SectionSurface surface(store, detail, without);
    for (int i = 0; i < 60; ++i) {
      const Point2 a = place(), b = place();
      const SectionLine line(store.metadata().grid, a, b);
      const CrossSection slow = test::slow_section(line, triangles);
      const std::string expected = test::text(line.is_mirrored() ? test::mirrored(slow) : slow);
      ASSERT_EQ(test::text(cross_section(store, a, b, detail, without)), expected);
      ASSERT_EQ(test::text(surface.between(a, b)), expected);
    }
  }
}

TEST_F(OmittedFeatures, AreRefusedWhereTheyDoNotExist) {
  const Store store(import("all.itin", town()));
  const std::uint16_t woods = theme_named_in(store, "woods");
  const auto omit = [&](FeatureNumber f) { return without_features(store, ThemeChoice::all(), {f}, progress_); };
  EXPECT_THROW(omit({0, 0}), InputError);
  EXPECT_THROW(omit({99, 0}), InputError);
  EXPECT_THROW(omit({woods, -1}), InputError);
  EXPECT_THROW(omit({woods, 12}), InputError);
  EXPECT_TRUE(omit({woods, 11}).omits(woods, 11));
}

}  // namespace
}  // namespace itin
