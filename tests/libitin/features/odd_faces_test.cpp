// The area that self-crossing rings enclose, against the number of their edges on the way to the outside; and how many
// crossings are taken apart.
#include "features/plan/odd_faces.hpp"

#include <atomic>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "features/mesh/entangled.hpp"
#include "features/plan/hot_pixel.hpp"
#include "features/plan/planarity.hpp"
#include "libitin/features/feature_fixture.hpp"
#include "support/impatient.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

using test::house;
using test::kFeatureGrid;
using test::meshed;
using test::reported;

GridRing random_ring(std::mt19937& random, std::int32_t side, unsigned corners) {
  const auto in = [&] { return static_cast<std::int32_t>(random() % static_cast<unsigned>(side)) - side / 2; };
  GridRing ring;
  for (unsigned i = 0; i < corners; ++i) ring.push_back({in(), in()});
  return ring;
}

PlanRing in_metres(const GridRing& ring) {
  PlanRing result;
  for (const Position& p : ring) result.push_back(kFeatureGrid.position(p.x, p.y));
  return result;
}

double distance(Position p, Position a, Position b) {
  const double dx = 1.0 * b.x - a.x, dy = 1.0 * b.y - a.y, px = 1.0 * p.x - a.x, py = 1.0 * p.y - a.y;
  const double squared = dx * dx + dy * dy;
  const double t = squared > 0 ? std::clamp((px * dx + py * dy) / squared, 0.0, 1.0) : 0;
  return std::hypot(px - t * dx, py - t * dy);
}

bool near(const GridRing& ring, Position p, double reach) {
  bool found = false;
  for_each_edge({ring, {}}, [&](Position a, Position b) { found = found || distance(p, a, b) <= reach; });
  return found;
}

TEST(OddFaces, AreWhereAWayOutsideCrossesOddlyManyEdges) {
  std::mt19937 random(test::seed());
  int inside = 0, outside = 0;
  for (int run = 0; run < 200; ++run) {
    const std::int32_t side = 20 << (random() % 18);
    GridRing ring = random_ring(random, side, 3 + random() % 30);
    if (random() % 3 == 0) ring.insert(ring.begin() + 1, {ring[1], ring[0]});  // there and back, and there again
    const GridPolygons faces = odd_faces(ring);
    for (int i = 0; i < 50; ++i) {
      const Position p = random_ring(random, side + side / 4, 1).front();
      if (near(ring, p, 2)) continue;  // edges were rounded
      const bool odd = covers({{ring, {}}}, {1.0 * p.x, 1.0 * p.y});
      (odd ? inside : outside) += 1;
      ASSERT_EQ(covers(faces, {1.0 * p.x, 1.0 * p.y}), odd) << "run " << run << ": " << p.x << ' ' << p.y;
    }
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 500);
}

TEST(OddFaces, NothingWhereTheWayBackIsTheWayThere) {
  EXPECT_TRUE(odd_faces({{0, 0}, {10, 0}, {10, 10}, {10, 0}}).empty());
  EXPECT_TRUE(odd_faces({{0, 0}, {7, 0}, {3, 0}}).empty());
}

TEST(Planarity, CountsWhereEdgesMeet) {
  std::mt19937 random(test::seed());
  for (int run = 0; run < 100; ++run) {
    const GridRing ring = random_ring(random, 6 << (random() % 24), 3 + random() % 60);
    std::vector<GridEdge> edges;
    for_each_edge({ring, {}}, [&](Position a, Position b) { edges.emplace_back(std::minmax(a, b)); });
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::erase_if(edges, [](const GridEdge& e) { return e.first == e.second; });
    std::uint64_t expected = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      for (std::size_t j = i + 1; j < edges.size(); ++j) {
        const auto& [a, b] = edges[i];
        const auto& [c, d] = edges[j];
        const auto within = [](Position from, Position to, Position p) {
          return p != from && p != to && on_segment(from, to, p) ? 1U : 0U;
        };
        expected += within(a, b, c) + within(a, b, d) + within(c, d, a) + within(c, d, b);
        expected += orientation(a, b, c) * orientation(a, b, d) < 0 && orientation(c, d, a) * orientation(c, d, b) < 0;
      }
    }
    ASSERT_EQ(count_conflicts(edges, 1'000'000), expected) << "run " << run;
    if (expected > 0) {
      ASSERT_EQ(count_conflicts(edges, expected - 1), expected) << "run " << run;
    }
  }
}

TEST(FeatureMesh, LeavesOutWhatCrossesItselfTooOften) {
  std::mt19937 random(test::seed());
  const FeatureMesh mesh = meshed({house("knot", {in_metres(random_ring(random, 50000, 2000))}, 0, 5),
                                   house("beside", {test::box_ring(600, 600, 610, 610)}, 0, 5)});
  EXPECT_EQ(mesh.built, 1U);
  EXPECT_EQ(mesh.refused, 1U);
  EXPECT_TRUE(reported(mesh, 0, "left out: crosses itself ")) << mesh.findings.at(0).text;
  EXPECT_TRUE(reported(mesh, " times, and more than 20000 crossings of 2000 edges are not taken apart"));
}

TEST(FeatureMesh, LeavesOutMeasuredRoofsThatCrossTooOften) {
  std::mt19937 random(test::seed());
  FootprintFeature model = house("model", {}, 0, 5);
  for (int i = 0; i < 40; ++i) {
    RoofSurface& surface = model.surfaces.emplace_back();
    surface.rings.emplace_back();
    for (const Point2& p : in_metres(random_ring(random, 5000, 50))) surface.rings[0].push_back({p.x, p.y, 5});
  }
  const FeatureMesh mesh = meshed({model});
  EXPECT_EQ(mesh.refused, 1U);
  EXPECT_TRUE(reported(mesh, 0, "left out: its outline crosses itself and its neighbours "))
      << mesh.findings.at(0).text;
}

Patch box_patch(std::int32_t xmin, std::int32_t ymin, std::int32_t xmax, std::int32_t ymax) {
  return {{{{{xmin, ymin}, {xmax, ymin}, {xmax, ymax}, {xmin, ymax}}, {}}}, {}, 0};
}

TEST(Entangled, NoMoreThanMustGo) {
  // 110 bands across 110: each crosses the others at 440 places, all together at 48,400.
  std::vector<Patch> patches;
  std::vector<std::uint32_t> owners;
  for (int i = 0; i < 110; ++i) patches.push_back(box_patch(0, 100 * i, 50000, 100 * i + 50));
  for (int i = 0; i < 110; ++i) patches.push_back(box_patch(100 * i + 5, -100, 100 * i + 55, 40000));
  for (std::uint32_t i = 0; i < patches.size(); ++i) owners.push_back(1000 + i);
  const std::map<std::uint32_t, std::string> gone = entangled(patches, owners);
  ASSERT_EQ(gone.size(), 65U);  // as 48,400 - 65 * 440 is the first that is not above 20,000
  EXPECT_EQ(gone.begin()->first, 1000U + 220 - 65) << "of equals the last go";
  for (const auto& [owner, why] : gone) {
    EXPECT_EQ(why,
              "left out: its outline crosses itself and its neighbours 440 times, where no more than 20000 crossings "
              "of 880 edges are taken apart");
  }
}

/// Teeth upward from y = -2; or, with x and y exchanged, to the right.
PlanRing comb(int teeth, bool exchanged) {
  PlanRing ring;
  const auto add = [&](double x, double y) {
    if (exchanged) std::swap(x, y);
    ring.push_back({kFeatureGrid.origin.x + x, kFeatureGrid.origin.y + y});
  };
  for (int i = 0; i < teeth; ++i) add(i, -1), add(i, 200), add(i + 0.5, 200), add(i + 0.5, -1);
  add(teeth, -1), add(teeth, -2), add(0, -2);
  return ring;
}

TEST(FeatureMesh, LeavesOutNeighboursThatCrossTooOften) {
  const FeatureMesh mesh =
      meshed({house("upward", {comb(75, false)}, 0, 5), house("to the right", {comb(75, true)}, 0, 5),
              house("beside", {test::box_ring(300, 300, 310, 310)}, 0, 5)});
  EXPECT_EQ(mesh.built, 2U);
  EXPECT_EQ(mesh.refused, 1U);
  EXPECT_TRUE(reported(mesh, 1, "left out: its outline crosses itself and its neighbours "));
  EXPECT_TRUE(reported(mesh, " times, where no more than 20000 crossings of 606 edges are taken apart"));
}

TEST(FeatureMesh, ALineThatCrossesItselfTooOftenIsNoWall) {
  std::mt19937 random(test::seed());
  EXPECT_THROW(band_about(in_metres(random_ring(random, 50000, 2000)), 0.3, kFeatureGrid), OverlayError);
}

TEST(FeatureMesh, IsCancelledInTheMidstOfOneFeature) {
  std::mt19937 random(test::seed());
  const std::vector<FootprintFeature> knot{house("knot", {in_metres(random_ring(random, 50000, 250))}, 0, 5)};
  FeatureOptions options;
  options.grid = kFeatureGrid;
  test::Impatient patient(1 << 30);
  build_feature_mesh(knot, options, nullptr, patient);
  EXPECT_GT(patient.asked(), 100) << "few looks within one feature";
  for (int looks = 0; looks < patient.asked(); looks += 1 + patient.asked() / 20) {
    test::Impatient impatient(looks);
    EXPECT_THROW(build_feature_mesh(knot, options, nullptr, impatient), Cancelled) << looks;
  }
}

/// However many corners one feature has, no step of the work on it goes without asking.
TEST(FeatureMesh, AsksOftenWithinOneLargeFeature) {
  constexpr int kCorners = 4000;
  std::mt19937 random(test::seed());
  GridRing star;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners, radius = 100000 + static_cast<double>(random() % 1000);
    star.push_back({static_cast<std::int32_t>(160000 + radius * std::cos(angle)),
                    static_cast<std::int32_t>(160000 + radius * std::sin(angle))});
  }
  FeatureOptions options;
  options.grid = kFeatureGrid;
  const Tin tin = test::fractal_tin(65, 50, 20, 0.5, static_cast<std::uint32_t>(random()));
  const TerrainHeights terrain(tin);
  test::Impatient patient(1 << 30);
  build_feature_mesh(std::vector{house("star", {in_metres(star)}, 0, 50)}, options, &terrain, patient);
  EXPECT_GT(patient.asked(), 20 * kCorners);
}

}  // namespace
}  // namespace itin
