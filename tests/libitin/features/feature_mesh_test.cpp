// Walls, feet and who gets the ground: by hand, and over random polygons against brute force.
#include "features/mesh/feature_mesh.hpp"

#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <itin/error.hpp>

#include "libitin/features/feature_fixture.hpp"
#include "support/seed.hpp"
#include "triangulate/mesh/delaunay.hpp"

namespace itin {
namespace {

using test::box_ring, test::expect_masked, test::expect_planar, test::house, test::kFeatureGrid, test::mask_area,
    test::meshed, test::reported;

/// The surface that a mesh makes by itself: the height above a position, by constrained triangulation of all lines.
class Surface {
 public:
  explicit Surface(const FeatureMesh& mesh) : mesh_(mesh) {
    std::vector<Position> positions;
    for (const GridPoint& p : mesh.vertices) positions.push_back({p.x, p.y});
    delaunay_.insert(positions);
    std::vector<Delaunay::Constraint> constraints;
    for (const FeatureSegment& s : mesh.segments) constraints.emplace_back(s.from, s.to);
    delaunay_.constrain(constraints);
    plane_ = delaunay_.mesh();
  }
  /// Metres from the grid's origin.
  double at(double x, double y) const {
    const Position p{static_cast<std::int32_t>(std::lround(x * 100)), static_cast<std::int32_t>(std::lround(y * 100))};
    for (const auto& t : plane_.triangles) {
      const GridPoint &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
      const double bc = static_cast<double>(doubled_area(b, c, p)), ca = static_cast<double>(doubled_area(c, a, p)),
                   ab = static_cast<double>(doubled_area(a, b, p));
      if (bc < 0 || ca < 0 || ab < 0) continue;
      return (bc * a.z + ca * b.z + ab * c.z) / (bc + ca + ab) * mesh_.grid.resolution;
    }
    return NAN;
  }

 private:
  const FeatureMesh& mesh_;
  Delaunay delaunay_;
  PlaneMesh plane_;
};

TEST(FeatureMesh, BuildsABoxOfTwoRings) {
  const FeatureMesh mesh = meshed({house("box", {box_ring(0, 0, 10, 6)}, 50, 8)});
  EXPECT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.segments.size(), 8U);
  EXPECT_TRUE(mesh.findings.empty());
  EXPECT_EQ(mesh.built, 1U);
  std::set<GridPoint> expected;
  for (const int x : {0, 1000})
    for (const int y : {0, 600}) expected.insert({x, y, 5000});
  for (const int x : {5, 995})
    for (const int y : {5, 595}) expected.insert({x, y, 5800});
  EXPECT_EQ(std::set<GridPoint>(mesh.vertices.begin(), mesh.vertices.end()), expected);
  expect_planar(mesh);
  expect_masked(mesh);
}

TEST(FeatureMesh, KeepsCourtyards) {
  const FeatureMesh mesh = meshed({house("court", {box_ring(0, 0, 20, 20), box_ring(5, 5, 15, 15)}, 0, 10)});
  EXPECT_EQ(mesh.segments.size(), 16U);
  EXPECT_EQ(test::side_of_masks(mesh, {1000, 1000}), Side::outside);
  EXPECT_EQ(test::side_of_masks(mesh, {200, 200}), Side::inside);
  EXPECT_NEAR(mask_area(mesh, 0), 300, 1e-9);
  const Surface surface(mesh);
  EXPECT_NEAR(surface.at(10, 10), 0, 1e-9);
  EXPECT_NEAR(surface.at(2, 10), 10, 1e-9);
  expect_planar(mesh);
}

TEST(FeatureMesh, BuildsAnIslandInACourtyard) {
  const FeatureMesh mesh = meshed({house("ring", {box_ring(0, 0, 20, 20), box_ring(5, 5, 15, 15)}, 0, 10),
                                   house("island", {box_ring(8, 8, 12, 12)}, 0, 4)});
  const Surface surface(mesh);
  EXPECT_NEAR(surface.at(10, 10), 4, 1e-9);
  EXPECT_NEAR(surface.at(6.5, 10), 0, 1e-9);
  EXPECT_EQ(mesh.built, 2U);
  EXPECT_TRUE(mesh.findings.empty());
}

// A street 8 m wide between 12 m and 9 m high: from its middle, 2 m up, the sky begins at atan(10/4) and atan(7/4).
TEST(FeatureMesh, MakesAStreetCanyon) {
  const FeatureMesh mesh =
      meshed({house("west", {box_ring(0, 0, 10, 60)}, 0, 12), house("east", {box_ring(18, 0, 28, 60)}, 0, 9)});
  const Surface surface(mesh);
  const auto horizon = [&](double direction) {
    double highest = 0;
    for (double d = 0.01; d < 13.9; d += 0.01)
      highest = std::max(highest, std::atan2(surface.at(14 + direction * d, 30) - 2, d));
    return highest * 180 / std::numbers::pi;
  };
  // The eaves stand 5 cm behind the wall's foot.
  EXPECT_NEAR(horizon(-1), std::atan2(10, 4.05) * 180 / std::numbers::pi, 0.01);
  EXPECT_NEAR(horizon(+1), std::atan2(7, 4.05) * 180 / std::numbers::pi, 0.01);
}

TEST(FeatureMesh, PutsThePartyWallIntoTheLowerHouse) {
  const std::vector<FootprintFeature> row{house("low", {box_ring(0, 0, 10, 10)}, 0, 5),
                                          house("high", {box_ring(10, 2, 20, 12)}, 0, 9)};
  const FeatureMesh mesh = meshed(row);
  expect_planar(mesh);
  expect_masked(mesh);
  const Surface surface(mesh);
  EXPECT_NEAR(surface.at(10, 6), 9, 1e-9) << "the party line stands at the higher eaves";
  EXPECT_NEAR(surface.at(9.94, 6), 5, 1e-9);
  EXPECT_NEAR(surface.at(10.02, 1), 0, 0.01);
  // The order of the houses does not matter.
  const FeatureMesh turned = meshed({row[1], row[0]});
  EXPECT_EQ(mesh.vertices, turned.vertices);
}

// The low house's north side is free for four metres, and then the high house stands at it.
TEST(FeatureMesh, NoStripOfAWallRisesTowardsAHigherNeighbour) {
  for (const RoofKind roof : {RoofKind::flat, RoofKind::gabled, RoofKind::hipped, RoofKind::skeleton}) {
    const FeatureMesh mesh =
        meshed({house("low", {box_ring(0, 0, 10, 10)}, 0, 4, roof), house("high", {box_ring(4, 10, 10, 20)}, 0, 8)});
    expect_planar(mesh);
    expect_masked(mesh);
    const Surface surface(mesh);
    for (double x = 0.1; x < 3.96; x += 0.05)
      for (double y = 9.94; y < 10; y += 0.01) ASSERT_LE(surface.at(x, y), 4 + 1e-9) << x << ' ' << y;
    for (double x = 4.1; x < 9.9; x += 0.05) ASSERT_NEAR(surface.at(x, 10), 8, 1e-9) << x;
  }
}

TEST(FeatureMesh, LeavesNoGrooveBetweenEquals) {
  const FeatureMesh mesh =
      meshed({house("a", {box_ring(0, 0, 10, 10)}, 0, 5), house("b", {box_ring(10, 0, 20, 10)}, 0, 5)});
  const Surface surface(mesh);
  for (double x = 9.5; x < 10.5; x += 0.01) ASSERT_NEAR(surface.at(x, 5), 5, 1e-9) << x;
  EXPECT_EQ(mesh.built, 2U);
}

TEST(FeatureMesh, GivesTheGroundToTheHigher) {
  const FeatureMesh mesh =
      meshed({house("low", {box_ring(0, 0, 10, 10)}, 0, 5), house("high", {box_ring(6, 2, 16, 8)}, 0, 9)});
  expect_planar(mesh);
  EXPECT_NEAR(mask_area(mesh, 0), 100 - 24, 1e-6);
  EXPECT_NEAR(mask_area(mesh, 1), 60, 1e-6);
  EXPECT_TRUE(reported(mesh, 0, "loses 24.0 %")) << testing::PrintToString(mesh.findings);
  const Surface surface(mesh);
  EXPECT_NEAR(surface.at(8, 5), 9, 1e-9);
}

TEST(FeatureMesh, BuildsDuplicatesOnce) {
  const FeatureMesh mesh =
      meshed({house("one", {box_ring(0, 0, 10, 10)}, 0, 5), house("two", {box_ring(0, 0, 10, 10)}, 0, 5)});
  EXPECT_EQ(mesh.built, 1U);
  EXPECT_EQ(mesh.refused, 1U);
  EXPECT_EQ(mesh.segments.size(), 8U);
  EXPECT_TRUE(reported(mesh, 1, "left out: lies wholly under others"));
}

TEST(FeatureMesh, RefusesWhatCannotStand) {
  FootprintFeature heightless = house("heightless", {box_ring(0, 0, 10, 10)}, 0, 5);
  heightless.height.reset();
  FootprintFeature baseless = house("baseless", {box_ring(20, 0, 30, 10)}, 0, 5);
  baseless.base.reset();
  FootprintFeature tree = house("tree", {box_ring(40, 0, 50, 10)}, 0, 5);
  tree.kind = FeatureKind::vegetation;
  const FeatureMesh mesh =
      meshed({heightless, baseless, tree, house("flat", {box_ring(0, 20, 10, 30)}, 0, 0),
              house("sliver", {box_ring(0, 40, 10, 40.09)}, 0, 5), house("line", {box_ring(0, 50, 10, 50)}, 0, 5),
              house("nothing", {}, 0, 5), house("far", {box_ring(1e9, 0, 1e9 + 1, 1)}, 0, 5)});
  EXPECT_EQ(mesh.built, 0U);
  EXPECT_EQ(mesh.refused, 8U);
  EXPECT_EQ(mesh.findings.size(), 8U);
  EXPECT_TRUE(mesh.segments.empty());
  EXPECT_TRUE(reported(mesh, 0, "left out: has no height"));
  EXPECT_TRUE(reported(mesh, 1, "left out: has no base height"));
  EXPECT_TRUE(reported(mesh, 2, "left out: follows the terrain"));
  EXPECT_TRUE(reported(mesh, 4, "left out: nowhere as wide"));
  EXPECT_TRUE(reported(mesh, 5, "left out: has no area"));
  EXPECT_TRUE(reported(mesh, 7, "left out: has coordinates beyond the grid"));
}

TEST(FeatureMesh, RepairsABowTie) {
  const PlanRing box = box_ring(0, 0, 10, 10);
  const FeatureMesh mesh = meshed({house("tie", {{box[0], box[2], box[1], box[3]}}, 0, 5)});
  EXPECT_EQ(mesh.built, 1U);
  EXPECT_NEAR(mask_area(mesh, 0), 50, 1e-6);
  EXPECT_TRUE(reported(mesh, 0, "crosses or touches itself"));
  expect_planar(mesh);
}

TEST(FeatureMesh, ChecksItsOptions) {
  FeatureOptions options;
  options.wall_offset = 0.01;
  EXPECT_THROW(meshed({}, nullptr, options), InputError);
  options.wall_offset = 0.02;
  options.pitch_degrees = 90;
  EXPECT_THROW(meshed({}, nullptr, options), InputError);
}

PlanRing random_ring(std::mt19937& random, double reach, int corners, Point2 centre) {
  std::uniform_real_distribution<double> anywhere(-reach, reach);
  PlanRing ring;
  for (int i = 0; i < corners; ++i) ring.push_back({centre.x + anywhere(random), centre.y + anywhere(random)});
  return ring;
}

struct Crowd {
  double reach;   ///< how far a polygon reaches from its centre, metres
  double spread;  ///< how far the centres lie from the middle, metres
  double offset;
};

class FeatureMeshCrowds : public testing::TestWithParam<Crowd> {};

// Self-crossing polygons of every size, overlapping each other, with every roof: whatever comes in, what comes out is
// planar, lies in its masks, and has heights between base and top.
TEST_P(FeatureMeshCrowds, StayPlanar) {
  std::mt19937 random(test::seed());
  const Crowd crowd = GetParam();
  std::uint64_t built = 0, refused = 0, joined = 0, flat = 0;
  for (int round = 0; round < 60; ++round) {
    std::uniform_real_distribution<double> anywhere(-crowd.spread, crowd.spread), height(1, 30);
    std::uniform_int_distribution<int> count(1, 6), corners(3, 9), roof(0, 3);
    std::vector<FootprintFeature> features;
    for (int i = count(random); i > 0; --i) {
      const Point2 centre{kFeatureGrid.origin.x + anywhere(random), kFeatureGrid.origin.y + anywhere(random)};
      features.push_back(house(fmt::format("f{}", i), {random_ring(random, crowd.reach, corners(random), centre)}, 10,
                               height(random), static_cast<RoofKind>(roof(random))));
    }
    FeatureOptions options;
    options.wall_offset = crowd.offset;
    const FeatureMesh mesh = meshed(features, nullptr, options);
    ASSERT_NO_FATAL_FAILURE(expect_planar(mesh)) << "round " << round;
    const bool snapped = reported(mesh, "were joined");
    if (!snapped) {
      ASSERT_NO_FATAL_FAILURE(expect_masked(mesh)) << "round " << round;
    }
    for (const FeatureSegment& s : mesh.segments) {
      for (const std::uint32_t v : {s.from, s.to}) {
        const double z = test::metres(mesh, mesh.vertices[v].z), top = 10 + *features[s.feature].height;
        ASSERT_GE(z, 10 - 1e-9);
        ASSERT_LE(z, (snapped ? 40 : top) + 0.0051);
        if (s.kind == SegmentClass::foot) {
          ASSERT_NEAR(z, 10, 1e-9);
        }
      }
    }
    built += mesh.built, refused += mesh.refused, flat += mesh.flat_instead, joined += snapped;
  }
  std::cout << built << " built, " << refused << " refused, " << flat << " flat instead; lines joined in " << joined
            << " of 60 rounds\n";
  EXPECT_GT(built, 0U);
}

INSTANTIATE_TEST_SUITE_P(OfAllSizes, FeatureMeshCrowds,
                         testing::Values(Crowd{15, 15, 0.05}, Crowd{3, 2, 0.05}, Crowd{0.5, 0.5, 0.02},
                                         Crowd{0.15, 0.1, 0.02}));

// Houses on ground as rough as they are large: nothing sinks into it, and its edges stay planar with all lines.
TEST(FeatureMesh, SurvivesAnythingOnRoughGround) {
  std::mt19937 random(test::seed());
  std::uint64_t built = 0, joined = 0, ground = 0;
  for (int round = 0; round < 40; ++round) {
    std::uniform_real_distribution<double> height(0.5, 9), rough(0, 6);
    const double step = round % 2 == 0 ? 2 : 7;
    const Tin tin = test::lattice_tin(
        20, 20, step, [&](auto, auto) { return rough(random); }, 0.01, kFeatureGrid.origin);
    const TerrainHeights terrain(tin);
    std::uniform_real_distribution<double> centre(6 * step, 13 * step);
    std::uniform_int_distribution<int> count(1, 6), corners(3, 9), roof(0, 3), kind(0, 2);
    std::vector<FootprintFeature> features;
    for (int i = count(random); i > 0; --i) {
      const Point2 at{kFeatureGrid.origin.x + centre(random), kFeatureGrid.origin.y + centre(random)};
      features.push_back(house(fmt::format("f{}", i), {random_ring(random, 2.5 * step, corners(random), at)}, 3,
                               height(random), static_cast<RoofKind>(roof(random))));
      features.back().kind = static_cast<FeatureKind>(kind(random));
      if (round % 3 != 0) features.back().base.reset();
    }
    const FeatureMesh mesh = meshed(features, &terrain);
    ASSERT_NO_FATAL_FAILURE(expect_planar(mesh)) << "round " << round;
    for (const GridPoint& p : mesh.vertices)
      ASSERT_GE(p.z, std::floor(*terrain.height_at({p.x, p.y}) / mesh.grid.resolution)) << "round " << round;
    built += mesh.built, joined += reported(mesh, "were joined"),
        ground += mesh.ground.pieces.size() + mesh.ground.border.size();
  }
  std::cout << built << " built, " << ground << " edges of ground; lines joined in " << joined << " of 40 rounds\n";
  EXPECT_GT(built, 40U);
  EXPECT_GT(ground, 1000U);
}

// Rectangles on a coarse lattice: edges overlap, corners meet edges and corners all the time.
TEST(FeatureMesh, SurvivesTouchingInEveryWay) {
  std::mt19937 random(test::seed());
  for (int round = 0; round < 60; ++round) {
    std::uniform_int_distribution<int> at(0, 6), side(1, 4), height(1, 3), roof(0, 3);
    std::vector<FootprintFeature> features;
    for (int i = 0; i < 6; ++i) {
      const int x = at(random), y = at(random);
      features.push_back(house("f", {box_ring(x, y, x + side(random), y + side(random))}, 0, 3 * height(random),
                               static_cast<RoofKind>(roof(random))));
    }
    const FeatureMesh mesh = meshed(features);
    ASSERT_NO_FATAL_FAILURE(expect_planar(mesh)) << "round " << round;
    ASSERT_NO_FATAL_FAILURE(expect_masked(mesh)) << "round " << round;
    ASSERT_FALSE(reported(mesh, "joined"));
    // Above the middle of every unit square stands, with flat roofs, the highest of those that cover it.
    bool all_flat = true;
    for (const FootprintFeature& f : features) all_flat &= f.roof == RoofKind::flat;
    if (!all_flat && round % 2 == 0) continue;
    std::vector<FootprintFeature> flats = features;
    for (FootprintFeature& f : flats) f.roof = RoofKind::flat;
    const FeatureMesh flat = meshed(flats);
    const Surface surface(flat);
    for (int x = 0; x < 10; ++x) {
      for (int y = 0; y < 10; ++y) {
        double expected = 0;
        for (const FootprintFeature& f : flats) {
          const double px = 300000 + x + 0.5, py = 200000 + y + 0.5;
          if (px > f.rings[0][0].x && px < f.rings[0][2].x && py > f.rings[0][0].y && py < f.rings[0][2].y)
            expected = std::max(expected, *f.height);
        }
        const double z = surface.at(x + 0.5, y + 0.5);
        if (std::isnan(z)) continue;
        ASSERT_NEAR(z, expected, 1e-9) << x << ' ' << y << " round " << round;
      }
    }
  }
}

}  // namespace
}  // namespace itin
