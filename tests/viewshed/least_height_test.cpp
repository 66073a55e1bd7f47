// The least height against the slow exact line of sight: the end found must touch the surface, or be a bound.
#include "least_height.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include "support/delaunay_tin.hpp"
#include "support/exact_line_of_sight.hpp"
#include "support/real_terrain.hpp"
#include "support/seed.hpp"
#include "support/terrain_tin.hpp"
#include "surface_heights.hpp"

namespace itin::viewshed {
namespace {

constexpr double kExactness = 1e-7;  ///< of double precision, metres

class Measured {
 public:
  Measured(const Tin& tin, const Earth& earth)
      : tin_(tin), scene_(tin, earth, NoData::kClear, 0), heights_(tin, earth, scene_), exact_(tin, earth) {}

  const test::ExactLineOfSight& exact() const { return exact_; }
  const LeastHeights& heights() const { return heights_; }

  /// Metres; a packet of one line.
  double find(const Point3& from, const Point3& to, double lower) {
    SightLines lines;
    set(lines, 0, from, to);
    LeastHeights::Heights bounds{};
    bounds[0] = lower / tin_.grid.resolution;
    return heights_.find(lines, bounds, memory_)[0] * tin_.grid.resolution;
  }

  void set(SightLines& lines, unsigned i, const Point3& from, const Point3& to) const {
    const double r = tin_.grid.resolution;
    lines.from_x[i] = easting_in_units(tin_.grid, from.x), lines.from_y[i] = northing_in_units(tin_.grid, from.y);
    lines.to_x[i] = easting_in_units(tin_.grid, to.x), lines.to_y[i] = northing_in_units(tin_.grid, to.y);
    lines.from_z[i] = from.z / r, lines.to_z[i] = to.z / r;
    lines.active |= 1U << i;
  }

  enum class Outcome { kHidden, kBound, kTouches };

  /// What the slow twin says of one result.
  Outcome check(const Point3& from, const Point3& upper, double lower, double found) const {
    const auto clearance = [&](double z) { return exact_.clearance(from, {upper.x, upper.y, z}); };
    if (std::isnan(found)) {
      EXPECT_LT(clearance(upper.z), -kGrazing + kExactness) << "visible at the upper height";
      return Outcome::kHidden;
    }
    EXPECT_GE(found, lower - kExactness);
    EXPECT_LE(found, upper.z + kExactness);
    EXPECT_GT(clearance(found), -kGrazing - kExactness) << "hidden at the height found";
    if (found <= lower + kExactness) return Outcome::kBound;
    EXPECT_LT(clearance(found), kExactness) << "seen from lower than the height found";
    return Outcome::kTouches;
  }

 private:
  const Tin& tin_;
  Scene scene_;
  LeastHeights heights_;
  test::ExactLineOfSight exact_;
  LeastHeights::Memory memory_;
};

struct Tally {
  int hidden = 0, bound = 0, touches = 0;
};

/// Packets of eyes close together, each looking at one axis somewhere.
Tally compare(const Tin& tin, const Earth& earth, double eye_height, double axis_height, std::mt19937& random) {
  Measured measured(tin, earth);
  const Box box = tin.bounds();
  std::uniform_real_distribution<double> share(0.02, 0.98), aside(-0.01, 0.01);
  Tally tally;
  LeastHeights::Memory memory;
  for (int packet = 0; packet < 30; ++packet) {
    const Point2 eye{box.xmin + share(random) * box.width(), box.ymin + share(random) * box.height()};
    const Point2 foot{box.xmin + share(random) * box.width(), box.ymin + share(random) * box.height()};
    const auto base = measured.exact().height(foot);
    if (!base) continue;
    SightLines lines;
    LeastHeights::Heights lower{};
    std::array<Point3, SightLines::kSize> from{};
    const Point3 to{foot.x, foot.y, *base + axis_height};
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      const Point2 p{eye.x + aside(random) * box.width(), eye.y + aside(random) * box.height()};
      const auto ground = measured.exact().height(p);
      if (!ground) continue;
      from[i] = {p.x, p.y, *ground + eye_height};
      measured.set(lines, i, from[i], to);
      lower[i] = *base / tin.grid.resolution;
    }
    const LeastHeights::Heights found = measured.heights().find(lines, lower, memory);
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      if ((lines.active >> i & 1) == 0) {
        EXPECT_TRUE(std::isnan(found[i]));
        continue;
      }
      switch (measured.check(from[i], to, *base, found[i] * tin.grid.resolution)) {
        case Measured::Outcome::kHidden:
          ++tally.hidden;
          break;
        case Measured::Outcome::kBound:
          ++tally.bound;
          break;
        case Measured::Outcome::kTouches:
          ++tally.touches;
          break;
      }
    }
  }
  return tally;
}

TEST(LeastHeight, RandomTins) {
  std::mt19937 random(test::seed());
  Tally all;
  for (int i = 0; i < 4; ++i) {
    const Tin tin = test::random_tin(random, 300, i % 2 == 0 ? 0 : 0.1, {{500000, 4000000}, 0.01}, 50000);
    const Tally tally = compare(tin, {}, i % 2 == 0 ? 2 : 0, 20, random);
    all.hidden += tally.hidden, all.bound += tally.bound, all.touches += tally.touches;
  }
  EXPECT_GT(all.hidden, 0);
  EXPECT_GT(all.touches, 100);
}

TEST(LeastHeight, FractalTerrainAtEveryRoughness) {
  std::mt19937 random(test::seed());
  for (const double roughness : {0.35, 0.5, 0.65}) {
    const Tin tin = test::fractal_tin(33, 50, 150, roughness, random());
    for (const double eye : {0.0, 2.0, 60.0}) {
      const Tally tally = compare(tin, {}, eye, 120, random);
      EXPECT_GT(tally.touches + tally.hidden, 0);
    }
  }
}

TEST(LeastHeight, LongEdgesOnACurvedEarth) {
  std::mt19937 random(test::seed());
  const Tin tin = test::fractal_tin(17, 4000, 60, 0.5, random());
  for (const double k : {0.13, 0.0, -0.5, 0.9}) {
    Earth earth;
    earth.refraction = k;
    EXPECT_GT(compare(tin, earth, 2, 200, random).touches, 50);
  }
}

TEST(LeastHeight, RealTerrain) {
  const auto tin = test::big_tujunga(300, 300, 40);
  if (!tin) GTEST_SKIP() << "needs " << test::big_tujunga_path();
  std::mt19937 random(test::seed());
  EXPECT_GT(compare(*tin, {}, 2, 150, random).touches, 50);
}

TEST(LeastHeight, BehindTheSeasHorizonFollowsTheFormula) {
  const Tin tin = test::lattice_tin(3, 3, 30000, [](auto, auto) { return 0.0; });
  const Earth earth;
  Measured measured(tin, earth);
  const double eye = 2, c = earth.drop_coefficient(), horizon = std::sqrt(eye / c);
  for (const double d : {1000.0, 5000.0, 12000.0, 40000.0}) {
    const Point3 from{301234, 210000, eye}, to{301234 + d, 210000, 500};
    const double expected = d <= horizon ? 0 : c * (d - horizon) * (d - horizon);
    EXPECT_NEAR(measured.find(from, to, 0), expected, 2e-5) << d;
  }
}

TEST(LeastHeight, AWallHidesInProportion) {
  // A wall 10 m high across the plane at 500 m; without curvature similar triangles tell.
  const Tin tin = test::lattice_tin(101, 11, 10, [](std::int32_t c, auto) { return c == 50 ? 10.0 : 0.0; });
  Measured measured(tin, Earth::flat());
  EXPECT_NEAR(measured.find({300100, 200050, 2}, {300900, 200050, 100}, 0), 18, 1e-5);
  EXPECT_NEAR(measured.find({300100, 200051, 2}, {300300, 200051, 100}, 0), 0, 1e-9);
  EXPECT_NEAR(measured.find({300100, 200053, 2}, {300300, 200053, 100}, 7), 7, 1e-9);
  EXPECT_TRUE(std::isnan(measured.find({300100, 200050, 2}, {300900, 200050, 17.9}, 0)));
  EXPECT_NEAR(measured.find({300100, 200050, 2}, {300900, 200050, 18}, 0), 18, 1e-5);
}

TEST(LeastHeight, AnEyeBeneathTheSurfaceSeesNothing) {
  const Tin tin = test::lattice_tin(11, 11, 10, [](auto, auto) { return 5.0; });
  Measured measured(tin, {});
  EXPECT_TRUE(std::isnan(measured.find({300050, 200050, 4.9}, {300090, 200050, 500}, 5)));
  EXPECT_NEAR(measured.find({300050, 200050, 5}, {300090, 200050, 500}, 5), 5, 2e-4);  // less the Earth's curvature
}

TEST(LeastHeight, CurtainsHideEveryHeight) {
  // A gap in the ground between two plates.
  const Tin tin = test::lattice_tin(30, 5, 10, [](std::int32_t c, auto) { return c > 10 && c < 20 ? NAN : 0.0; });
  const Earth earth;
  const Scene scene(tin, earth, NoData::kBlock, 200);
  const LeastHeights heights(tin, earth, scene);
  Measured helper(tin, earth);
  SightLines lines;
  helper.set(lines, 0, {300050, 200020, 2}, {300250, 200020, 150});
  helper.set(lines, 1, {300050, 200020, 2}, {300095, 200020, 150});
  LeastHeights::Memory memory;
  const auto found = heights.find(lines, {}, memory);
  EXPECT_TRUE(std::isnan(found[0]));
  EXPECT_NEAR(found[1], 0, 1e-3);
}

}  // namespace
}  // namespace itin::viewshed
