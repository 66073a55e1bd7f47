// Heights under features against brute force over all triangles, and what drapes against the terrain itself.
#include "features/mesh/terrain_heights.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "libitin/features/feature_fixture.hpp"
#include "support/delaunay_tin.hpp"
#include "support/seed.hpp"
#include "triangulate/mesh/delaunay.hpp"

namespace itin {
namespace {

using test::expect_planar, test::kFeatureGrid, test::meshed;

double plane(const Tin& tin, const Triangle& t, double x, double y) {
  const GridPoint &a = tin.vertices[t[0]], &b = tin.vertices[t[1]], &c = tin.vertices[t[2]];
  const auto cross = [](double px, double py, double qx, double qy) { return px * qy - py * qx; };
  const double whole = cross(b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y);
  const double wb = cross(x - a.x, y - a.y, c.x - a.x, c.y - a.y) / whole;
  const double wc = cross(b.x - a.x, b.y - a.y, x - a.x, y - a.y) / whole;
  return (a.z + wb * (b.z - a.z) + wc * (c.z - a.z)) * tin.grid.resolution;
}

std::optional<double> slow_height(const Tin& tin, Position p) {
  for (const Triangle& t : tin.triangles) {
    const GridPoint &a = tin.vertices[t[0]], &b = tin.vertices[t[1]], &c = tin.vertices[t[2]];
    if (orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0)
      return plane(tin, t, p.x, p.y);
  }
  return std::nullopt;
}

/// Points some way off a lattice's nodes: no two so near, and no triangle so thin, that rounding to the grid matters.
Tin even_tin(std::mt19937& random) {
  std::uniform_int_distribution<std::int32_t> aside(-250, 250), height(-100, 1000);
  std::vector<GridPoint> points;
  for (std::int32_t x = -10000; x <= 10000; x += 1000)
    for (std::int32_t y = -10000; y <= 10000; y += 1000)
      points.push_back({x + aside(random), y + aside(random), height(random)});
  const std::vector<std::uint16_t> sources(points.size(), 0);
  return test::delaunay_tin(kFeatureGrid, points, sources, [](auto&, auto&, auto&) { return true; });
}

GridPolygons star(std::mt19937& random, Position centre, double radius) {
  std::uniform_real_distribution<double> scale(0.4, 1);
  GridRing ring;
  for (int i = 0; i < 11; ++i) {
    const double a = i * 2 * 3.14159265358979 / 11, r = radius * scale(random);
    ring.push_back(
        {centre.x + static_cast<std::int32_t>(r * std::cos(a)), centre.y + static_cast<std::int32_t>(r * std::sin(a))});
  }
  return {GridPolygon{ring, {}}};
}

TEST(TerrainHeights, AgreeWithEveryTriangle) {
  std::mt19937 random(test::seed());
  const Tin tin = test::random_tin(random, 400, 0.05, kFeatureGrid);
  const TerrainHeights terrain(tin);
  std::uniform_int_distribution<std::int32_t> anywhere(-11000, 11000);
  for (int i = 0; i < 2000; ++i) {
    const Position p{anywhere(random), anywhere(random)};
    const auto expected = slow_height(tin, p), found = terrain.height_at(p);
    ASSERT_EQ(expected.has_value(), found.has_value());
    if (found) {
      ASSERT_NEAR(*found, *expected, 1e-9);
    }
  }
  for (const GridPoint& v : tin.vertices) ASSERT_EQ(*terrain.height_at({v.x, v.y}), v.z * 0.01);
}

TEST(TerrainHeights, FindAllCrossings) {
  std::mt19937 random(test::seed());
  const Tin tin = test::random_tin(random, 200, 0, kFeatureGrid);
  const TerrainHeights terrain(tin);
  std::uniform_int_distribution<std::int32_t> anywhere(-9000, 9000);
  for (int i = 0; i < 200; ++i) {
    const Position a{anywhere(random), anywhere(random)}, b{anywhere(random), anywhere(random)};
    std::set<std::pair<std::uint32_t, std::uint32_t>> crossed;
    for (const Triangle& t : tin.triangles) {
      for (int k = 0; k < 3; ++k) {
        const auto &p = tin.vertices[t[k]], &q = tin.vertices[t[(k + 1) % 3]];
        if (orientation(a, b, p) * orientation(a, b, q) < 0 && orientation(p, q, a) * orientation(p, q, b) < 0)
          crossed.insert(std::minmax(t[k], t[(k + 1) % 3]));
      }
    }
    const std::vector<Position> found = terrain.crossings(a, b);
    // All edges about a vertex that is passed closely may round to one position.
    ASSERT_LE(found.size(), crossed.size());
    for (const auto& [v, w] : crossed) {
      const auto &p = tin.vertices[v], &q = tin.vertices[w];
      const auto sp = static_cast<double>(doubled_area(a, b, p)), sq = static_cast<double>(doubled_area(a, b, q));
      const double part = sp / (sp - sq), x = p.x + part * (1.0 * q.x - p.x), y = p.y + part * (1.0 * q.y - p.y);
      const auto near = [&](const Position& f) { return std::abs(f.x - x) <= 0.51 && std::abs(f.y - y) <= 0.51; };
      ASSERT_TRUE(near(a) || near(b) || std::any_of(found.begin(), found.end(), near)) << x << ' ' << y;
    }
    double last = -1;
    for (const Position& p : found) {
      const double along = std::hypot(p.x - a.x, p.y - a.y);
      ASSERT_GE(along, last - 1);
      last = along;
      ASSERT_LE(std::abs(static_cast<double>(doubled_area(a, b, p))) / std::hypot(b.x - a.x, b.y - a.y), 0.7072);
    }
  }
}

TEST(TerrainHeights, BaseRulesAgreeWithDenseSampling) {
  std::mt19937 random(test::seed());
  for (int round = 0; round < 10; ++round) {
    const Tin tin = test::random_tin(random, 300, round % 2 ? 0.1 : 0, kFeatureGrid);
    const TerrainHeights terrain(tin);
    const GridPolygons footprint = star(random, {1000 * round - 5000, 2000}, 4000);
    double low = INFINITY, high = -INFINITY, sum = 0, count = 0;
    for (std::int32_t x = -13000; x < 13000; x += 53) {
      for (std::int32_t y = -3000; y < 7000; y += 53) {
        if (side_of(footprint.front(), {x, y}) == Side::outside) continue;
        const auto z = terrain.height_at({x, y});
        if (!z) continue;
        low = std::min(low, *z), high = std::max(high, *z), sum += *z, ++count;
      }
    }
    const double minimum = *terrain.base_height(footprint, BaseRule::minimum);
    const double maximum = *terrain.base_height(footprint, BaseRule::maximum);
    EXPECT_LE(minimum, low + 1e-9);
    EXPECT_GE(maximum, high - 1e-9);
    // Random heights up to 10 m over a few metres are steep: samples half a metre apart miss the extremes by so much.
    EXPECT_NEAR(minimum, low, 1.0);
    EXPECT_NEAR(maximum, high, 1.0);
    EXPECT_NEAR(*terrain.base_height(footprint, BaseRule::mean), sum / count, 0.05);
  }
}

TEST(TerrainHeights, MeanOnAPlaneIsTheHeightAtTheCentroid) {
  const Tin tin = test::lattice_tin(11, 11, 10, [](auto c, auto r) { return 100 + 2.0 * c + 3.0 * r; });
  const TerrainHeights terrain(tin);
  const GridPolygons court{{{{2000, 1000}, {5000, 1000}, {5000, 5000}, {1000, 5000}, {1000, 2000}, {2000, 2000}}, {}}};
  // 40 m square less 10 m square at its corner: centroid (16 30 - 1 15) / 15 = 31 m.
  EXPECT_NEAR(*terrain.base_height(court, BaseRule::mean), 100 + 31 * 0.5, 1e-9);
  EXPECT_NEAR(*terrain.base_height(court, BaseRule::minimum), 100 + 20 * 0.2 + 10 * 0.3, 1e-9);
  EXPECT_NEAR(*terrain.base_height(court, BaseRule::maximum), 100 + 50 * 0.5, 1e-9);
  EXPECT_FALSE(terrain.base_height({GridPolygon{{{-500, -500}, {-400, -500}, {-400, -400}}, {}}}, BaseRule::mean));
}

/// Terrain without what the masks cover, and the mesh: the surface with features.
class Joined {
 public:
  Joined(const Tin& tin, const FeatureMesh& mesh) {
    for (const GridPoint& v : tin.vertices)
      if (test::side_of_masks(mesh, {v.x, v.y}) == Side::outside) points_.push_back(v);
    const auto first = static_cast<std::uint32_t>(points_.size());
    points_.insert(points_.end(), mesh.vertices.begin(), mesh.vertices.end());
    std::vector<Position> positions;
    for (const GridPoint& p : points_) positions.push_back({p.x, p.y});
    std::vector<Delaunay::Constraint> constraints;
    for (const FeatureSegment& s : mesh.segments) constraints.emplace_back(first + s.from, first + s.to);
    Delaunay delaunay;
    delaunay.insert(positions);
    delaunay.constrain(constraints);
    tin_.grid = tin.grid;
    tin_.vertices = points_;
    tin_.triangles = delaunay.mesh().triangles;
  }
  const Tin& tin() const { return tin_; }

 private:
  std::vector<GridPoint> points_;
  Tin tin_;
};

// The top of what drapes is the terrain's own triangles, raised: anywhere inside, not only at vertices.
TEST(Drape, RepeatsTheTerrain) {
  std::mt19937 random(test::seed());
  for (int round = 0; round < 5; ++round) {
    const Tin tin = even_tin(random);
    const TerrainHeights terrain(tin);
    FootprintFeature wood;
    wood.name = "wood";
    wood.kind = FeatureKind::vegetation;
    wood.height = 12;
    PlanRing& ring = wood.rings.emplace_back();
    const GridPolygons plan = star(random, {0, 0}, 6000);
    for (const Position& p : plan.front().outline) ring.push_back(kFeatureGrid.position(p.x, p.y));
    const FeatureMesh mesh = meshed({wood}, &terrain);
    ASSERT_EQ(mesh.built, 1U) << testing::PrintToString(mesh.findings);
    expect_planar(mesh);
    const Joined joined(tin, mesh);
    const TerrainHeights surface(joined.tin());
    for (const FeatureSegment& s : mesh.segments) {
      if (s.kind == SegmentClass::wall) continue;  // from foot to top
      for (const std::uint32_t v : {s.from, s.to}) {
        const GridPoint& p = mesh.vertices[v];
        ASSERT_NEAR(p.z * 0.01, *terrain.height_at({p.x, p.y}) + (s.kind == SegmentClass::foot ? 0 : 12), 0.0101);
      }
    }
    const GridPolygons top = eroded({mesh.masks.front().polygon}, 7);
    std::uniform_int_distribution<std::int32_t> anywhere(-6000, 6000);
    int inside = 0;
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
      const Position p{anywhere(random), anywhere(random)};
      if (!covers(top, {1.0 * p.x, 1.0 * p.y})) continue;
      ++inside;
      worst = std::max(worst, std::abs(*surface.height_at(p) - *terrain.height_at(p) - 12));
      if (inside > 300) break;
    }
    EXPECT_GT(inside, 100);
    // Crossings are rounded to the grid, by 0.7 cm at most, on slopes up to 4.
    EXPECT_LT(worst, 0.04);
    std::cout << "worst " << worst << " m\n";
  }
}

TEST(Drape, FollowsAPlaneExactly) {
  const Tin tin = test::lattice_tin(11, 11, 10, [](auto c, auto r) { return 100 + 2.0 * c + 3.0 * r; });
  const TerrainHeights terrain(tin);
  FootprintFeature wall;
  wall.name = "wall";
  wall.kind = FeatureKind::wall;
  wall.height = 2;
  const Point2 o = tin.grid.origin;
  wall.rings = band_about({{o.x + 12, o.y + 13}, {o.x + 71, o.y + 44}, {o.x + 80, o.y + 90}}, 0.3, tin.grid);
  const FeatureMesh mesh = meshed({wall}, &terrain);
  ASSERT_EQ(mesh.built, 1U) << testing::PrintToString(mesh.findings);
  expect_planar(mesh);
  EXPECT_NEAR(test::mask_area(mesh, 0), 0.3 * (std::hypot(59, 31) + std::hypot(9, 46)), 0.4);
  for (const FeatureSegment& s : mesh.segments) {
    if (s.kind == SegmentClass::wall) continue;  // from foot to top
    const GridPoint& p = mesh.vertices[s.from];
    ASSERT_NEAR(p.z * 0.01, 100 + p.x * 0.002 + p.y * 0.003 + (s.kind == SegmentClass::foot ? 0 : 2), 0.0101);
  }
}

TEST(Drape, ReportsWhatReachesBeyondTheTerrain) {
  const Tin tin = test::lattice_tin(11, 11, 10, [](auto, auto) { return 100.0; });
  const TerrainHeights terrain(tin);
  FootprintFeature wood;
  wood.name = "wood";
  wood.kind = FeatureKind::vegetation;
  wood.height = 12;
  wood.rings = {test::box_ring(50, 50, 150, 70)};
  const FeatureMesh mesh = meshed({wood}, &terrain);
  EXPECT_EQ(mesh.built, 0U);
  EXPECT_TRUE(test::reported(mesh, 0, "left out: reaches beyond the terrain"));
}

TEST(Building, TakesItsBaseByTheRule) {
  const Tin tin = test::lattice_tin(11, 11, 10, [](auto c, auto) { return 100 + 1.0 * c; });
  const TerrainHeights terrain(tin);
  FootprintFeature house = test::house("house", {test::box_ring(20, 20, 40, 30)}, 0, 8);
  house.base.reset();
  const auto foot_and_eaves = [&](BaseRule rule) {
    house.base_rule = rule;
    const FeatureMesh mesh = meshed({house}, &terrain);
    return std::array{test::heights(mesh, 0, SegmentClass::foot).first,
                      test::heights(mesh, 0, SegmentClass::foot).second,
                      test::heights(mesh, 0, SegmentClass::eaves).first};
  };
  // The foot lies on the terrain, whatever the base.
  EXPECT_EQ(foot_and_eaves(BaseRule::minimum), (std::array{102.0, 104.0, 110.0}));
  EXPECT_EQ(foot_and_eaves(BaseRule::mean), (std::array{102.0, 104.0, 111.0}));
  EXPECT_EQ(foot_and_eaves(BaseRule::maximum), (std::array{102.0, 104.0, 112.0}));
  EXPECT_EQ(foot_and_eaves(BaseRule::terrain_following), (std::array{102.0, 104.0, 111.0}));
}

}  // namespace
}  // namespace itin
