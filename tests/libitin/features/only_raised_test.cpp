// Raised features only raise the surface: nowhere is it lower than the bare terrain, and outside of footprints it is
// the bare terrain. On random footprints over rough ground; raised_theme_test.cpp looks at real ones.
#include <cmath>
#include <gmock/gmock.h>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "libitin/features/surface_comparison.hpp"
#include "support/houses.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/sound_store.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

using test::LineFeature, test::SurfaceComparison;

class OnlyRaised : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }
  double in(double low, double high) { return low + (high - low) * static_cast<double>(random_() % 100001) / 100000; }

  template <class Height>
  void ground(double step, const Height& height) const {
    test::write_raster(path("t.tif"), {300000, 200000, step, 40, 40, 27700}, height);
    ImportOptions options;
    options.sources = {path("t.tif")};
    NoProgress progress;
    import_terrain(path("s.itin"), options, progress);
  }

  ImportReport raise(ThemeKind kind, const std::string& theme, const std::vector<LineFeature>& features,
                     const ImportOptions& options = {}) const {
    return test::import_raised(path("s.itin"), path(theme + ".geojson"), kind, theme, features, options);
  }

  LineFeature polygon(Point2 centre, double least, double greatest, int corners, double height) {
    LineFeature f;
    f.polygon = true;
    const double turn = in(0, 6.28);
    for (int i = 0; i < corners; ++i) {
      const double angle = turn + i * 6.283185307 / corners, r = in(least, greatest);
      f.vertices.push_back({centre.x + r * std::cos(angle), centre.y + r * std::sin(angle), 0});
    }
    f.vertices.push_back(f.vertices.front());
    f.properties = fmt::format(R"({{"h":{}}})", height);
    return f;
  }

  void compare(const ThemeChoice& choice, bool kept = true) {
    NoProgress progress;
    const Store store(path("s.itin"));
    const Tin bare = triangulate(store, Window::all(), Detail::tolerance(0), progress, ThemeChoice::none());
    const Tin themed = triangulate(store, Window::all(), Detail::tolerance(0), progress, choice);
    SurfaceComparison comparison(bare, themed);
    comparison.everywhere(random_);
    comparison.expect_only_raised();
    if (kept) comparison.expect_ground_kept();
    EXPECT_GT(comparison.positions(), bare.vertices.size());
    test::expect_sound(store);
  }

  test::TemporaryDirectory directory_;
  std::mt19937 random_{test::seed()};
};

struct Rules {
  const char* name;
  BaseRule base;
  RoofKind roof;
  double step;    ///< from post to post, metres
  double height;  ///< the greatest height of a feature, metres
};

class OnlyRaisedByRule : public OnlyRaised, public testing::WithParamInterface<Rules> {};

// Ground as rough as high: houses on it are dug in, stand on slopes and on edges.
TEST_P(OnlyRaisedByRule, NoHouseLowersTheGround) {
  const Rules rules = GetParam();
  ground(rules.step, [&](int, int) { return 100 + in(0, rules.step); });
  std::vector<LineFeature> houses;
  for (int i = 0; i < 40; ++i) {
    const Point2 centre{300000 + in(2, 37) * rules.step, 200000 - in(2, 37) * rules.step};
    houses.push_back(polygon(centre, 3, 12, 3 + static_cast<int>(random_() % 6), in(1, rules.height)));
  }
  ImportOptions options;
  options.base = rules.base;
  options.roof = rules.roof;
  const ImportReport report = raise(ThemeKind::Buildings, "houses", houses, options);
  EXPECT_GT(report.features, 20u);
  compare(ThemeChoice::all());
}

INSTANTIATE_TEST_SUITE_P(Rules, OnlyRaisedByRule,
                         testing::Values(Rules{"minimum", BaseRule::minimum, RoofKind::flat, 10, 6},
                                         Rules{"maximum", BaseRule::maximum, RoofKind::gabled, 10, 9},
                                         Rules{"mean", BaseRule::mean, RoofKind::hipped, 3, 6},
                                         Rules{"following", BaseRule::terrain_following, RoofKind::skeleton, 10, 9},
                                         Rules{"coarse", BaseRule::minimum, RoofKind::skeleton, 50, 20}),
                         [](const auto& p) { return p.param.name; });

TEST_F(OnlyRaised, NoWoodLowersTheGround) {
  ground(5, [&](int, int) { return 100 + in(0, 5); });
  std::vector<LineFeature> woods;
  for (int i = 0; i < 8; ++i)
    woods.push_back(
        polygon({300000 + in(30, 160), 200000 - in(30, 160)}, 5, 25, 4 + static_cast<int>(random_() % 9), in(0.5, 12)));
  raise(ThemeKind::Vegetation, "woods", woods);
  compare(ThemeChoice::all());
}

/// Much of the ground is level, so that features lie on level triangles next to steep ones.
TEST_F(OnlyRaised, NothingOnLevelGroundChangesTheSlopesAboutIt) {
  ground(5, [&](int, int) { return in(0, 1) < 0.85 ? 100 : 104; });
  std::vector<LineFeature> houses;
  for (int i = 0; i < 60; ++i)
    houses.push_back(polygon({300000 + in(20, 170), 200000 - in(20, 170)}, 1, 4, 4, in(1, 9)));
  raise(ThemeKind::Buildings, "houses", houses);
  compare(ThemeChoice::all());
}

/// On contours, with points inferred between them: what stands gives these vertices where it crosses them, and stands
/// on what has become of the ground then.
TEST_F(OnlyRaised, NoHouseLowersGroundOfContours) {
  std::vector<LineFeature> contours;
  for (int k = 0; k < 9; ++k) {
    LineFeature& ring = contours.emplace_back();
    const double turn = in(0, 6.28), wobble = in(0.05, 0.15);
    for (int i = 0; i <= 48; ++i) {
      const double angle = i % 48 * 6.283185307 / 48, r = (12 + 11 * k) * (1 + wobble * std::sin(3 * angle) / (k + 1));
      ring.vertices.push_back(
          {300100 + r * std::cos(angle + turn), 199900 + r * std::sin(angle + turn), 200.0 - 5 * k});
    }
  }
  test::write_lines(path("contours.geojson"), contours);
  ImportOptions options;
  options.sources = {path("contours.geojson")};
  options.kind = ThemeKind::Contours;
  NoProgress progress;
  EXPECT_GT(import_lines(path("s.itin"), options, progress).inferred, 0U);
  std::vector<LineFeature> houses;
  for (int i = 0; i < 12; ++i)
    houses.push_back(polygon({300100 + in(-70, 70), 199900 + in(-70, 70)}, 4, 12, 4, in(1, 9)));
  raise(ThemeKind::Buildings, "houses", houses);
  compare(ThemeChoice::all());
}

/// Woods and houses that overlap.
TEST_F(OnlyRaised, NothingTogetherLowersTheGround) {
  ground(5, [&](int, int) { return 100 + in(0, 5); });
  std::vector<LineFeature> woods, houses;
  for (int i = 0; i < 5; ++i)
    woods.push_back(polygon({300000 + in(40, 150), 200000 - in(40, 150)}, 10, 30, 7, in(1, 9)));
  for (int i = 0; i < 30; ++i)
    houses.push_back(polygon({300000 + in(20, 170), 200000 - in(20, 170)}, 3, 12, 5, in(1, 9)));
  raise(ThemeKind::Vegetation, "woods", woods);
  raise(ThemeKind::Buildings, "houses", houses);
  for (const char* choice : {"houses", "woods", "all"}) compare(ThemeChoice::parse(choice));
}

}  // namespace
}  // namespace itin
