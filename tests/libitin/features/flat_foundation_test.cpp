// Buildings on flat foundations: their outlines lie at their bases, the ground about them slopes to these within the
// terrain's triangles that an outline crosses, and the index says how deep they cut. On rough ground, with a contour
// and a road across some, and others on walls that touch them.
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <itin/feature_cuts.hpp>
#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "features/mesh/terrain_heights.hpp"
#include "support/corner_triangles.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"
#include "support/sound_store.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

using test::LineFeature, test::TriangleCorners, test::triangles_of;

constexpr double kPlotSide = 400;
constexpr Point2 kPlotCorner{300000, 200000};
const Window kPlotPart = Window::box({300120.5, 199710.5, 300262.5, 199848.5});

class FlatFoundation : public testing::TestWithParam<BaseRule> {
 protected:
  using Features = std::vector<LineFeature>;

  std::string path(const std::string& name) const { return directory_.file(name); }
  double in(double low, double high) { return low + (high - low) * static_cast<double>(random_() % 100001) / 100000; }

  void make_ground() {
    test::write_raster(path("t.tif"), {kPlotCorner.x, kPlotCorner.y, 10, 40, 40, 27700},
                       [&](int, int) { return 100 + in(0, 8); });
    ImportOptions options;
    options.sources = {path("t.tif")};
    NoProgress progress;
    import_terrain(path("s.itin"), options, progress);
  }

  void add(ThemeKind kind, const std::string& theme, const Features& features,
           std::optional<Foundation> foundation = std::nullopt) {
    test::write_lines(path(theme + ".geojson"), features, !is_terrain(kind));
    ImportOptions options;
    options.sources = {path(theme + ".geojson")};
    options.kind = kind;
    options.theme = theme;
    if (kind == ThemeKind::Buildings) {
      options.height = 7;
      options.base = GetParam();
      options.foundation = foundation;
    }
    NoProgress progress;
    import_lines(path("s.itin"), options, progress);
  }

  static LineFeature box(Point2 corner, double width, double depth) {
    return test::box(corner.x, corner.y, corner.x + width, corner.y + depth, 7);
  }

  Features scattered(int count) {
    Features houses;
    for (int i = 0; i < count; ++i)
      houses.push_back(box({kPlotCorner.x + in(20, 360), kPlotCorner.y - 10 - in(20, 360)}, in(4, 24), in(4, 14)));
    return houses;
  }

  /// Far enough apart that none shares a triangle of the ground.
  Features apart() {
    Features houses;
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < 6; ++k)
        houses.push_back(box({kPlotCorner.x + 40 + 50 * i, kPlotCorner.y - 55 - 50 * k}, in(4, 14), in(4, 14)));
    return houses;
  }

  LineFeature line(double y) {
    LineFeature f;
    for (double x = 25; x < kPlotSide - 20; x += 35) f.vertices.push_back({kPlotCorner.x + x, y + in(-20, 20), 104});
    return f;
  }

  /// Houses wall to wall on slopes, beside a road, on a contour, and houses on walls.
  void make_town() {
    make_ground();
    Features houses = scattered(40);
    for (int i = 0; i < 8; ++i)
      houses.push_back(box({kPlotCorner.x + 60 + 12 * i, kPlotCorner.y - 100}, 12, in(6, 20)));
    add(ThemeKind::Buildings, "flat", houses, Foundation::flat);
    add(ThemeKind::Buildings, "on_walls", scattered(20));
    add(ThemeKind::Roads, "roads", {line(kPlotCorner.y - 95), line(kPlotCorner.y - 205)});
    add(ThemeKind::Contours, "contours", {line(kPlotCorner.y - 150), line(kPlotCorner.y - 290)});
  }

  Tin surface(const ThemeChoice& themes, const Window& window = Window::all(), double tolerance = 0) const {
    const Store store(path("s.itin"));
    NoProgress progress;
    return triangulate(store, window, Detail::tolerance(tolerance), progress, themes);
  }

  /// The heights of the surface along the outline, less the least, grid steps.
  static double unevenness(const TerrainHeights& heights, const LineFeature& house, const Grid& grid) {
    double low = 1e9, high = -1e9;
    for (std::size_t i = 0; i + 1 < house.vertices.size(); ++i) {
      const GridPoint p = grid.quantise(house.vertices[i]);
      const double z = *heights.height_at({p.x, p.y});
      low = std::min(low, z), high = std::max(high, z);
    }
    return (high - low) / grid.resolution;
  }

  /// Some place of a triangle of the surface.
  GridPoint place_in(const Tin& tin, const Triangle& t) {
    const double u = in(0, 1), v = in(0, 1) * (1 - u), w = 1 - u - v;
    const GridPoint &a = tin.vertices[t[0]], &b = tin.vertices[t[1]], &c = tin.vertices[t[2]];
    return {static_cast<std::int32_t>(std::lround(u * a.x + v * b.x + w * c.x)),
            static_cast<std::int32_t>(std::lround(u * a.y + v * b.y + w * c.y)), 0};
  }

  test::TemporaryDirectory directory_;
  std::mt19937 random_{test::seed()};
};

TEST_P(FlatFoundation, OutlinesLieAtOneHeight) {
  const Features houses = apart();
  make_ground();
  add(ThemeKind::Buildings, "flat", houses, Foundation::flat);
  add(ThemeKind::Roads, "roads", {line(kPlotCorner.y - 52), line(kPlotCorner.y - 205)});
  add(ThemeKind::Contours, "contours", {line(kPlotCorner.y - 150), line(kPlotCorner.y - 290)});
  const Store store(path("s.itin"));
  const Tin themed = surface(ThemeChoice::all());
  const TerrainHeights heights(themed);
  const Grid& grid = store.metadata().grid;
  for (const LineFeature& house : houses) {
    EXPECT_LE(unevenness(heights, house, grid), 1.01);
    const GridPoint a = grid.quantise(house.vertices[0]), c = grid.quantise(house.vertices[2]);
    const double base = *heights.height_at({a.x, a.y}) / grid.resolution;
    for (const GridPoint& v : themed.vertices) {
      const bool within = v.x >= a.x && v.x <= c.x && v.y >= a.y && v.y <= c.y;
      const bool on_edge = v.x == a.x || v.x == c.x || v.y == a.y || v.y == c.y;
      if (within && on_edge) {
        EXPECT_NEAR(v.z, base, 1.01) << v.x << ' ' << v.y;
      }
    }
  }
  test::expect_sound(store);
}

TEST_P(FlatFoundation, BeyondTheTrianglesThatOutlinesCrossTheGroundIsAsItWas) {
  make_ground();
  const auto without = triangles_of(surface(ThemeChoice::none()));
  const Features houses = apart();
  add(ThemeKind::Buildings, "flat", houses, Foundation::flat);
  EXPECT_EQ(triangles_of(surface(ThemeChoice::none())), without);
  const auto themed = triangles_of(surface(ThemeChoice::all()));
  const Grid grid = Store(path("s.itin")).metadata().grid;
  std::size_t kept = 0;
  for (const TriangleCorners& t : without) {
    const bool far = std::all_of(houses.begin(), houses.end(), [&](const LineFeature& house) {
      const GridPoint a = grid.quantise(house.vertices[0]), c = grid.quantise(house.vertices[2]);
      GridBox box;
      for (const GridPoint& p : t) box.extend(p.x, p.y);
      return !box.meets({a.x, a.y, c.x, c.y});
    });
    if (!far) continue;
    EXPECT_TRUE(themed.contains(t));
    ++kept;
  }
  EXPECT_GT(kept, 0U);
}

TEST_P(FlatFoundation, WhereHousesTouchTheLowerBaseHolds) {
  make_ground();
  add(ThemeKind::Buildings, "flat",
      {box({300100, 199800}, 12, 9), box({300112, 199800}, 14, 9), box({300126, 199800}, 11, 9)}, Foundation::flat);
  const Tin themed = surface(ThemeChoice::all());
  const TerrainHeights heights(themed);
  const Grid grid = Store(path("s.itin")).metadata().grid;
  const auto at = [&](double x, double y) {
    const GridPoint p = grid.quantise({x, y, 0});
    return *heights.height_at({p.x, p.y});
  };
  const double first = at(300100, 199800), last = at(300137, 199800);
  EXPECT_NEAR(at(300100, 199809), first, grid.resolution * 1.01);
  EXPECT_NEAR(at(300137, 199809), last, grid.resolution * 1.01);
  EXPECT_LE(at(300112, 199800), first + grid.resolution);
  EXPECT_LE(at(300126, 199800), last + grid.resolution);
  test::expect_sound(Store(path("s.itin")));
}

/// What the index says bounds the surface from below, wherever it is and whatever stands there.
TEST_P(FlatFoundation, NothingIsLowerThanTheIndexSays) {
  make_town();
  const Store store(path("s.itin"));
  const Tin bare = surface(ThemeChoice::none());
  const TerrainHeights ground(bare);
  for (const char* themes : {"all", "flat", "on_walls"}) {
    const ThemeChoice choice = ThemeChoice::parse(themes);
    const Tin themed = surface(choice);
    const TerrainHeights raised(themed);
    const std::vector<Certificate> cuts = feature_cuts(store, choice, bare.bounds());
    EXPECT_EQ(cuts.empty(), themes == std::string("on_walls"));
    int lowered = 0;
    for (const Triangle& t : themed.triangles) {
      const GridPoint p = place_in(themed, t);
      const auto low = ground.height_at({p.x, p.y}), high = raised.height_at({p.x, p.y});
      if (!low || !high) continue;
      const double below = (*high - *low) / store.metadata().grid.resolution;
      lowered += below < -5 ? 1 : 0;
      EXPECT_GE(below, -deepest_cut(cuts, {p.x, p.y, p.x, p.y}) - 2) << themes << ' ' << p.x << ' ' << p.y;
    }
    if (!cuts.empty() && GetParam() != BaseRule::maximum) {
      EXPECT_GT(lowered, 0);
    }
  }
  test::expect_sound(store);
}

TEST_P(FlatFoundation, WindowsAreTheWhole) {
  make_town();
  const Grid grid = Store(path("s.itin")).metadata().grid;
  for (const char* themes : {"all", "flat"}) {
    for (const double tolerance : {0.0, 1.0, 4.0}) {
      const ThemeChoice choice = ThemeChoice::parse(themes);
      const auto whole = triangles_of(surface(choice, Window::all(), tolerance));
      const auto part = triangles_of(surface(choice, kPlotPart, tolerance));
      EXPECT_FALSE(part.empty());
      EXPECT_TRUE(std::includes(whole.begin(), whole.end(), part.begin(), part.end())) << themes << tolerance;
      const Box box = kPlotPart.bounds();
      for (const TriangleCorners& t : whole) {
        const bool inside = std::any_of(t.begin(), t.end(), [&](const GridPoint& p) {
          const Point2 at = grid.position(p.x, p.y);
          return at.x > box.xmin && at.x < box.xmax && at.y > box.ymin && at.y < box.ymax;
        });
        if (inside) {
          EXPECT_TRUE(part.contains(t));
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Bases, FlatFoundation, testing::Values(BaseRule::minimum, BaseRule::mean, BaseRule::maximum),
                         [](const auto& p) {
                           return p.param == BaseRule::minimum ? "minimum"
                                  : p.param == BaseRule::mean  ? "mean"
                                                               : "maximum";
                         });

}  // namespace
}  // namespace itin
