// What stands only raises the surface: nowhere is it lower than the bare terrain, and outside of footprints it is the
// bare terrain. On random footprints over rough ground, and on real ones.
#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include <itin/import.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "features/terrain_heights.hpp"
#include "support/raster_file.hpp"
#include "support/temporary_directory.hpp"
#include "support/vector_file.hpp"

namespace itin {
namespace {

using test::LineFeature;

/// How steep a triangulation is about a position: roundings of positions to the grid cost so many heights.
double slope_of(const Tin& tin, const Triangle& t) {
  const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
  const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z, vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
  return std::hypot(nx, ny) / nz;
}

/// The surface of a choice of themes against the bare one.
class Comparison {
 public:
  Comparison(const Tin& bare, const Tin& themed) : bare_(bare), themed_(themed), low_(bare), high_(themed) {
    for (const Triangle& t : bare.triangles) steepest_ = std::max(steepest_, slope_of(bare, t));
  }

  /// Rounding: a grid step, and a step aside on the steepest slope.
  double allowed() const { return bare_.grid.resolution * (1 + steepest_); }

  void at(Position p) {
    const auto low = low_.height_at(p), high = high_.height_at(p);
    if (!low) return;
    ASSERT_TRUE(high) << p.x << ' ' << p.y;
    ++positions_;
    if (*high - *low < lowest_) lowest_ = *high - *low, where_ = p;
    if (theme_at(p) == 0) outside_ = std::max(outside_, std::abs(*high - *low));
  }

  void everywhere(std::mt19937& random) {
    for (const Tin* tin : {&bare_, &themed_})
      for (const GridPoint& p : tin->vertices) at({p.x, p.y});
    // Within and beside what stands, where things are small.
    for (const Triangle& t : themed_.triangles) {
      for (int i = 0; i < 2; ++i) {
        const double u = unit(random), v = unit(random) * (1 - u), w = 1 - u - v;
        const GridPoint &a = themed_.vertices[t[0]], &b = themed_.vertices[t[1]], &c = themed_.vertices[t[2]];
        at({static_cast<std::int32_t>(std::lround(u * a.x + v * b.x + w * c.x)),
            static_cast<std::int32_t>(std::lround(u * a.y + v * b.y + w * c.y))});
      }
    }
  }

  void expect_only_raised() const {
    const Point2 p = bare_.grid.position(where_.x, where_.y);
    EXPECT_GE(lowest_, -allowed()) << "at " << std::fixed << p.x << ' ' << p.y;
    std::cout << positions_ << " positions; lowest " << lowest_ << " m (allowed " << -allowed()
              << "), outside features up to " << outside_ << " m off\n";
  }
  void expect_ground_kept() const { EXPECT_LE(outside_, allowed()); }
  std::uint64_t positions() const { return positions_; }

 private:
  static double unit(std::mt19937& random) { return static_cast<double>(random() % 1000001) / 1000000; }

  /// Not zero near any part of a feature.
  std::uint16_t theme_at(Position p) const {
    for (const std::uint32_t t : high_.triangles_near({p.x - 2, p.y - 2, p.x + 2, p.y + 2}))
      if (const std::uint16_t theme = themed_.theme(themed_.triangles[t])) return theme;
    return 0;
  }

  const Tin &bare_, &themed_;
  TerrainHeights low_, high_;
  double steepest_ = 0, lowest_ = 0, outside_ = 0;
  Position where_;
  std::uint64_t positions_ = 0;
};

class OnlyRaised : public testing::Test {
 protected:
  OnlyRaised() {
    const auto seed = static_cast<unsigned>(testing::UnitTest::GetInstance()->random_seed());
    std::cout << "seed " << seed << "\n";
    random_.seed(seed);
  }
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
                     ImportOptions options = {}) const {
    test::write_lines(path(theme + ".geojson"), features, true);
    options.sources = {path(theme + ".geojson")};
    options.kind = kind;
    options.theme = theme;
    options.height_field = "h";
    NoProgress progress;
    return import_lines(path("s.itin"), options, progress);
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
    Comparison comparison(bare, themed);
    comparison.everywhere(random_);
    comparison.expect_only_raised();
    if (kept) comparison.expect_ground_kept();
    EXPECT_GT(comparison.positions(), bare.vertices.size());
    for (const Damage& damage : check(store, progress)) ADD_FAILURE() << damage.place << ": " << damage.what;
  }

  test::TemporaryDirectory directory_;
  std::mt19937 random_;
};

struct Rules {
  const char* name;
  BaseRule base;
  RoofKind roof;
  double step;    ///< of posts, metres
  double height;  ///< of features, at most
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

/// What stands in each other's way.
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

// Real ground and real houses.
TEST_F(OnlyRaised, AlexandriaStandsOnItsGround) {
  const std::string data = std::string(ITIN_DATA_DIR) + "/alexandria-va-2m/";
  if (!std::filesystem::exists(data + "dtm.tif")) GTEST_SKIP() << data << " is not there";
  NoProgress progress;
  ImportOptions options;
  options.sources = {data + "dtm.tif"};
  import_terrain(path("s.itin"), options, progress);
  options.sources = {data + "buildings.geojson"};
  options.kind = ThemeKind::Buildings;
  options.height_field = "HEIGHT";
  EXPECT_GT(import_lines(path("s.itin"), options, progress).features, 75u);
  compare(ThemeChoice::all());
}

}  // namespace
}  // namespace itin
