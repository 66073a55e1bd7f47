// What a pyramid of heights leaves out never hides anything: every triangle is tried against every line.
#include "bounds/height_pyramid.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <itin/earth.hpp>
#include <itin/lattice_tin.hpp>

#include "line/sight_line.hpp"
#include "support/seed.hpp"
#include "support/terrain_tin.hpp"

namespace itin::viewshed {
namespace {

constexpr int kPostsAcross = 49;
constexpr double kApart = 20;

class HeightPyramidTest : public testing::Test {
 protected:
  HeightPyramidTest() : tin_(test::fractal_tin(kPostsAcross, kApart, 90, 0.6, random_())) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  /// A place over the surface, grid units.
  Point2 place() {
    const Box box = tin_.bounds();
    const Point2 p{uniform(box.xmin, box.xmax), uniform(box.ymin, box.ymax)};
    return {(p.x - tin_.grid.origin.x) / tin_.grid.resolution, (p.y - tin_.grid.origin.y) / tin_.grid.resolution};
  }

  /// Lines from places near each other to places near each other, low and high.
  std::vector<SightLine> bundle_of_lines() {
    const Point2 from = place(), to = place();
    const double spread = uniform(0, 4000), drop = uniform(0, 1) < 0.5 ? 0 : 7e-8 * tin_.grid.resolution;
    std::vector<SightLine> lines;
    for (int i = 0; i < 5; ++i) {
      const Point3 a{from.x + uniform(0, spread), from.y + uniform(0, spread), uniform(-2000, 14000)},
          b{to.x + uniform(0, spread), to.y + uniform(0, spread), uniform(-2000, 14000)};
      lines.emplace_back(a, b, drop, 1e-6);
    }
    return lines;
  }

  /// Searches a pyramid for what may hide the lines, and returns how many triangles it left out.
  template <class Surface>
  std::size_t left_out(const HeightPyramid& pyramid, const Surface& triangles, const std::vector<SightLine>& lines) {
    LineBundle bundle(lines.front());
    double end = lines.front().to_z();
    for (const SightLine& line : lines) bundle.add(line), end = std::min(end, line.to_z());
    bundle.end = end;
    std::set<std::uint32_t> found;
    pyramid.search(bundle, [&](std::uint32_t triangle) { found.insert(triangle); });
    std::size_t missing = 0;
    for (const std::uint32_t t : triangles) {
      if (found.contains(t)) continue;
      ++missing;
      const auto [a, b, c] = pyramid.corners(t);
      for (const SightLine& line : lines) EXPECT_FALSE(line.hidden_by(a, b, c)) << "triangle " << t;
    }
    return missing;
  }

  std::mt19937 random_{test::seed()};
  Tin tin_;
};

std::vector<std::uint32_t> all_of(const Tin& tin) {
  std::vector<std::uint32_t> triangles(tin.triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) triangles[t] = t;
  return triangles;
}

std::vector<std::uint32_t> all_of(const LatticeTin& lattice) {
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t cell = 0; cell < lattice.tiles.size() * LatticeTin::kCells; ++cell)
    lattice.for_each_triangle(cell, [&](std::uint32_t t) {
      triangles.push_back(t);
      return true;
    });
  return triangles;
}

TEST_F(HeightPyramidTest, LeavesOutNothingThatHides) {
  const std::optional<LatticeTin> lattice = lattice_of(tin_);
  ASSERT_TRUE(lattice);
  const HeightPyramid of_tin(tin_), of_lattice(*lattice);
  const std::vector<std::uint32_t> listed = all_of(tin_), cells = all_of(*lattice);
  ASSERT_EQ(listed.size(), cells.size());
  std::size_t from_tin = 0, from_lattice = 0;
  for (int i = 0; i < 200; ++i) {
    const std::vector<SightLine> lines = bundle_of_lines();
    from_tin += left_out(of_tin, listed, lines);
    from_lattice += left_out(of_lattice, cells, lines);
  }
  // A search that visits everything would pass, and be of no use.
  EXPECT_GT(from_tin, 200 * listed.size() / 2);
  EXPECT_GT(from_lattice, 200 * listed.size() / 2);
}

TEST_F(HeightPyramidTest, KnowsTheHeightEverywhere) {
  const std::optional<LatticeTin> lattice = lattice_of(tin_);
  const HeightPyramid of_tin(tin_), of_lattice(*lattice);
  for (int i = 0; i < 500; ++i) {
    const Point2 p = place();
    std::optional<double> expected;
    for (const auto t : all_of(tin_)) {
      const auto [a, b, c] = tin_.corners(t);
      const auto side = [&](const GridPoint& u, const GridPoint& v) {
        return (double{1} * v.x - u.x) * (p.y - u.y) - (double{1} * v.y - u.y) * (p.x - u.x);
      };
      const double over_c = side(a, b), over_a = side(b, c), over_b = side(c, a);
      if (over_a < 0 || over_b < 0 || over_c < 0) continue;
      expected = (over_a * a.z + over_b * b.z + over_c * c.z) / (over_a + over_b + over_c);
      break;
    }
    for (const HeightPyramid* pyramid : {&of_tin, &of_lattice}) {
      const std::optional<double> height = pyramid->height_at(p);
      ASSERT_EQ(height.has_value(), expected.has_value());
      if (expected) {
        ASSERT_NEAR(*height, *expected, 1e-6);
      }
    }
  }
  EXPECT_FALSE(of_tin.height_at({-1e7, 0}));
  EXPECT_FALSE(of_lattice.height_at({-1e7, 0}));
}

}  // namespace
}  // namespace itin::viewshed
