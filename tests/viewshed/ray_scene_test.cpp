// Rays miss no triangle that hides a line: against every triangle by itself, and against a line of sight that shares no
// code with them, over needles, walls, corners and long edges, with eyes near, far and high, whatever the instructions.
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "line/sight_line.hpp"
#include "scene/rays/scene.hpp"
#include "support/delaunay_tin.hpp"
#include "support/exact_line_of_sight.hpp"
#include "support/seed.hpp"
#include "support/temporary_directory.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

constexpr Grid kUnits{{300000, 200000}, 0.01};

class RayScene : public testing::Test {
 protected:
  double in(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  std::int32_t step(std::int32_t low, std::int32_t high) {
    return std::uniform_int_distribution<std::int32_t>(low, high)(random_);
  }

  /// Points at random, of which some are at the same place but for a step, far above or below each other.
  Tin walls(std::int32_t side, std::int32_t height) {
    std::vector<GridPoint> points;
    for (int i = 0; i < 60; ++i) {
      const GridPoint p{step(0, side), step(0, side), step(0, height)};
      points.push_back(p);
      if (i % 2 == 0) points.push_back({p.x + 1, p.y + i % 4 / 2, p.z + step(-height, height)});
    }
    return test::delaunay_tin(kUnits, points, std::vector<std::uint16_t>(points.size()),
                              [](const auto&, const auto&, const auto&) { return true; });
  }

  /// Long thin triangles: two rows of points, close together, which end far apart.
  Tin needles() {
    std::vector<GridPoint> points;
    for (int i = 0; i < 50; ++i) {
      points.push_back({i * 40000 + step(0, 100), step(0, 3), step(0, 2000)});
      points.push_back({i * 40000 + step(0, 100), 50 + step(0, 3), step(0, 2000)});
    }
    return test::delaunay_tin(kUnits, points, std::vector<std::uint16_t>(points.size()),
                              [](const auto&, const auto&, const auto&) { return true; });
  }

  /// An end on a vertex, on an edge, or anywhere within and about the surface, at or above it or far from it.
  Point3 end_over(const Tin& tin, int kind) {
    const Triangle& t = tin.triangles[random_() % tin.triangles.size()];
    const GridPoint &a = tin.vertices[t[0]], &b = tin.vertices[t[1]], &c = tin.vertices[t[2]];
    const double u = kind % 4 == 0 ? 0 : in(0, 1), v = kind % 4 < 2 ? 0 : in(0, 1 - u);
    Point3 p{a.x + u * (b.x - a.x) + v * (c.x - a.x), a.y + u * (b.y - a.y) + v * (c.y - a.y),
             a.z + u * (b.z - a.z) + v * (c.z - a.z)};
    if (kind % 3 == 1) p.z += in(-50, 500);
    if (kind % 7 == 3) p.x += in(-1e6, 1e6), p.y += in(-1e6, 1e6);  // 10 km away
    if (kind % 11 == 5) p.z += in(0, 1e6);
    if (kind % 13 == 6) p.z -= in(0, 1e6);
    return p;
  }

  /// A place to which the line from the eye passes over a corner, hardly above or below it.
  Point3 beyond_a_corner(const Tin& tin, const Point3& eye) {
    const GridPoint& v = tin.vertices[random_() % tin.vertices.size()];
    const double further = in(1, 1.5), below = in(-0.01, 0.03);
    return {eye.x + further * (v.x - eye.x), eye.y + further * (v.y - eye.y), eye.z + further * (v.z - below - eye.z)};
  }

  SightLines lines_over(const Tin& tin, int round) {
    SightLines lines;
    const Point3 eye = end_over(tin, round);
    lines.start_at(eye);
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      Point3 to = end_over(tin, round / 3 + static_cast<int>(i));
      if (round % 3 == 2) to = beyond_a_corner(tin, eye);
      if (round % 5 == 4) to = {eye.x + in(-2, 2), eye.y + in(-2, 2), eye.z + in(-20, 20)};
      if (to.x == eye.x && to.y == eye.y) continue;
      lines.to_x[i] = to.x, lines.to_y[i] = to.y, lines.to_z[i] = to.z;
      lines.active |= 1U << i;
    }
    return lines;
  }

  static std::pair<Point3, Point3> ends(const SightLines& lines, unsigned i) {
    return {{lines.from_x[i], lines.from_y[i], lines.from_z[i]}, {lines.to_x[i], lines.to_y[i], lines.to_z[i]}};
  }

  /// Every triangle, one after another.
  static bool hidden_by_any(const Tin& tin, const Earth& earth, const SightLines& lines, unsigned i) {
    const auto [from, to] = ends(lines, i);
    const SightLine line(from, to, earth.drop_coefficient() * tin.grid.resolution, kGrazing / tin.grid.resolution);
    return std::any_of(tin.triangles.begin(), tin.triangles.end(), [&](const Triangle& t) {
      return line.hidden_by(tin.vertices[t[0]], tin.vertices[t[1]], tin.vertices[t[2]]);
    });
  }

  void expect_as_every_triangle(const Tin& tin, const Earth& earth, int rounds) {
    std::vector<Scene> scenes;
    for (const Instructions instructions : instructions_here()) scenes.emplace_back(tin, earth, kGrazing, instructions);
    const Scene& scene = scenes.back();
    const test::ExactLineOfSight twin(tin, earth);
    for (int round = 0; round < rounds; ++round) {
      SCOPED_TRACE(round);
      const SightLines lines = lines_over(tin, round);
      const unsigned hidden = scene.hidden(lines);
      EXPECT_EQ(hidden & ~lines.active, 0U);
      for (const Scene& other : scenes) EXPECT_EQ(other.hidden(lines), hidden);
      Scene::Stretches stretches;
      scene.find_hidden(lines, stretches);
      for (unsigned i = 0; i < SightLines::kSize; ++i) {
        if ((lines.active >> i & 1) == 0) continue;
        const bool is_hidden = (hidden >> i & 1) != 0;
        hidden_ += is_hidden, visible_ += !is_hidden;
        ASSERT_EQ(is_hidden, hidden_by_any(tin, earth, lines, i)) << "line " << i;
        EXPECT_EQ(is_hidden, !stretches[i].empty()) << "line " << i;
        // Whether a line that passes a corner or an edge of the rim touches it is a matter of rounding.
        if (round % 4 == 3 && round % 3 != 2 && (round / 3 + static_cast<int>(i)) % 4 >= 2)
          expect_as_twin(twin, lines, i, is_hidden);
      }
    }
  }

  void expect_as_twin(const test::ExactLineOfSight& twin, const SightLines& lines, unsigned i, bool hidden) {
    const auto metres = [](const Point3& p) {
      return Point3{kUnits.origin.x + p.x * kUnits.resolution, kUnits.origin.y + p.y * kUnits.resolution,
                    p.z * kUnits.resolution};
    };
    const auto [from, to] = ends(lines, i);
    const double clearance = twin.clearance(metres(from), metres(to));
    // A step in plan beside a wall of a million steps is that much in height.
    if (std::abs(clearance + kGrazing) < 0.02) return;
    EXPECT_EQ(hidden, clearance < -kGrazing) << "line " << i << ", clearance " << clearance;
    ++compared_;
  }

  void expect_both_and_reset() {
    EXPECT_GT(hidden_, 100U);
    EXPECT_GT(visible_, 100U);
    EXPECT_GT(compared_, 50U);
    hidden_ = visible_ = compared_ = 0;
  }

  std::mt19937 random_{test::seed()};
  std::size_t hidden_ = 0, visible_ = 0, compared_ = 0;
};

TEST_F(RayScene, MissesNothingOverWalls) {
  for (const double refraction : {0.13, 1.0, 1.5})
    for (int surface = 0; surface < 8; ++surface) {
      Earth earth;
      earth.refraction = refraction;
      expect_as_every_triangle(walls(surface % 2 == 0 ? 20000 : 2000000, 5000), earth, 60);
    }
  expect_both_and_reset();
}

TEST_F(RayScene, MissesNothingOverNeedles) {
  for (int surface = 0; surface < 8; ++surface) expect_as_every_triangle(needles(), Earth(), 60);
  expect_both_and_reset();
}

/// Edges of 20 km bulge above their corners' plane, far from the grid's origin.
TEST_F(RayScene, MissesNothingOverLongEdges) {
  for (int surface = 0; surface < 8; ++surface) {
    Tin tin = test::random_tin(random_, 30, 0, kUnits, 4000000);
    for (GridPoint& p : tin.vertices) p.x += 40000000, p.y += 900000000;
    expect_as_every_triangle(tin, Earth(), 60);
  }
  expect_both_and_reset();
}

/// Lines level with a plane, on it and along its edges and corners.
TEST_F(RayScene, MissesNothingWhereLinesGraze) {
  const Tin tin = test::lattice_tin(12, 12, 10, [](int c, int r) { return c % 5 == 2 && r % 4 == 1 ? 0.02 : 0; });
  Earth flat;
  flat.curvature = false;
  const Scene scene(tin, flat);
  std::size_t hidden = 0, visible = 0;
  for (int round = 0; round < 400; ++round) {
    SightLines lines;
    const auto place = [&] {
      const double half = round % 2 == 0 ? 0.5 : 1;
      return Point3{half * step(-2, 24) * 1000, half * step(-2, 24) * 1000, round % 3 == 0 ? 1.0 * step(0, 2) : 0};
    };
    lines.start_at(place());
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      const Point3 to = place();
      if (to.x == lines.from_x[0] && to.y == lines.from_y[0]) continue;
      lines.to_x[i] = to.x, lines.to_y[i] = to.y, lines.to_z[i] = to.z;
      lines.active |= 1U << i;
    }
    const unsigned found = scene.hidden(lines);
    for (unsigned i = 0; i < SightLines::kSize; ++i) {
      if ((lines.active >> i & 1) == 0) continue;
      const bool is_hidden = (found >> i & 1) != 0;
      ASSERT_EQ(is_hidden, hidden_by_any(tin, flat, lines, i)) << "round " << round << ", line " << i;
      hidden += is_hidden, visible += !is_hidden;
    }
  }
  EXPECT_GT(hidden, 100U);
  EXPECT_GT(visible, 100U);
}

/// Embree takes its instruction set from a file in the working directory.
TEST_F(RayScene, AnswersAlikeByAllInstructions) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path before = std::filesystem::current_path();
  const Tin tin = walls(200000, 5000);
  std::vector<SightLines> all;
  for (int round = 0; round < 60; ++round) all.push_back(lines_over(tin, round));
  std::vector<std::vector<unsigned>> answers;
  for (const std::string isa : {"sse2", "sse4.2", "avx", "avx2"}) {
    for (const std::string version : {"3", "4"})
      std::ofstream(directory.file(".embree" + version)) << "isa=" << isa << '\n';
    std::filesystem::current_path(std::filesystem::path(directory.file(".")));
    const Scene scene(tin, Earth());
    std::filesystem::current_path(before);
    std::vector<unsigned>& hidden = answers.emplace_back();
    for (const SightLines& lines : all) hidden.push_back(scene.hidden(lines));
  }
  for (const auto& hidden : answers) EXPECT_EQ(hidden, answers.front());
}

TEST_F(RayScene, HoldsNothingOverNoSurface) {
  Tin none;
  none.grid = kUnits;
  SightLines lines;
  lines.to_x.fill(100);
  lines.active = 0xffff;
  EXPECT_EQ(Scene(none, Earth()).hidden(lines), 0U);
}

}  // namespace
}  // namespace itin::viewshed
