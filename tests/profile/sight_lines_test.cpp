#include "support/sight_lines.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include <itin/earth.hpp>
#include <itin/tin.hpp>

#include "support/same_bits.hpp"
#include "support/seed.hpp"
#include "support/triangle_buckets.hpp"

namespace itin::test {

namespace {

/// A lattice of (columns + 1) x (rows + 1) posts, `spacing` metres apart, from the origin; heights in metres from
/// height(column, row), diagonals alternating.
template <typename Height>
Tin lattice(int columns, int rows, double spacing, const Height& height) {
  Tin tin;
  const auto index = [&](int c, int r) { return static_cast<std::uint32_t>(r * (columns + 1) + c); };
  for (int r = 0; r <= rows; ++r) {
    for (int c = 0; c <= columns; ++c)
      tin.vertices.push_back(tin.grid.quantise({c * spacing, r * spacing, height(c, r)}));
  }
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const std::uint32_t a = index(c, r), b = index(c + 1, r), d = index(c, r + 1), e = index(c + 1, r + 1);
      if ((c + r) % 2 == 0) {
        tin.triangles.insert(tin.triangles.end(), {{a, b, e}, {a, e, d}});
      } else {
        tin.triangles.insert(tin.triangles.end(), {{a, b, d}, {b, e, d}});
      }
    }
  }
  tin.sources.assign(tin.vertices.size(), 0);
  return tin;
}

Tin ridge() {
  return lattice(2, 2, 50, [](int c, int) { return c == 1 ? 10.0 : 0.0; });
}

TEST(SightLines, IsBlockedByARidgeAsFarAsItRisesAboveTheRay) {
  const Tin tin = ridge();
  const SightLine line = SightLines(tin, Earth::flat()).between({10, 30, 5}, {90, 30, 7});
  EXPECT_FALSE(line.visible());
  EXPECT_DOUBLE_EQ(line.length, 80);
  ASSERT_TRUE(line.clearance);
  EXPECT_DOUBLE_EQ(*line.clearance, -4);  // the ray is at 6 where the ridge is at 10
  EXPECT_EQ(line.critical, (Point3{50, 30, 10}));
}

TEST(SightLines, GrazingTheSurfaceIsVisible) {
  const Tin tin = ridge();
  const SightLines sight_lines(tin, Earth::flat());
  EXPECT_EQ(sight_lines.between({0, 30, 10}, {100, 30, 10}).clearance, 0.0);
  EXPECT_TRUE(sight_lines.between({0, 30, 10}, {100, 30, 10}).visible());
  EXPECT_TRUE(sight_lines.between({0, 0, 0}, {50, 0, 10}).visible());  // along the slope itself
  EXPECT_FALSE(sight_lines.between({0, 30, 9.999}, {100, 30, 10}).visible());
}

TEST(SightLines, RunsAlongEdgesAndThroughVertices) {
  const Tin tin = ridge();
  const SightLines sight_lines(tin, Earth::flat());
  EXPECT_EQ(sight_lines.between({0, 50, 8}, {100, 50, 8}).clearance, -2.0);   // along edges, through a vertex
  EXPECT_EQ(sight_lines.between({50, 0, 11}, {50, 100, 12}).clearance, 1.0);  // along the ridge, due north
  EXPECT_EQ(sight_lines.between({0, 100, 8}, {100, 0, 8}).clearance, -2.0);   // along diagonals
  EXPECT_EQ(sight_lines.between({-10, 50, 3}, {10, 50, 3}).clearance, 1.0);   // from outside: ground at 2 below its end
}

TEST(SightLines, DipsBetweenTheEndsOnACurvedEarth) {
  // A plane of two triangles: no breakpoint between the ends. The chord dips by L^2 (1 - k) / 8 R at its middle.
  const Tin tin = lattice(1, 1, 10000, [](int, int) { return 0.0; });
  const Earth earth = Earth{};
  const double dip = 8000.0 * 8000.0 * (1 - 0.13) / (8 * 6371000.0);
  const SightLine line = SightLines(tin, earth).between({1000, 100, 1}, {9000, 100, 1});
  ASSERT_TRUE(line.clearance);
  EXPECT_NEAR(*line.clearance, 1 - dip, 1e-9);
  EXPECT_NEAR(line.critical.x, 5000, 1e-6);
  EXPECT_NEAR(*SightLines(tin, Earth::flat()).between({1000, 100, 1}, {9000, 100, 1}).clearance, 1, 1e-12);
  // The lower end draws the lowest point towards it: t = 1/2 + (z1 - z0) / (2 c L^2) with c = (1 - k) / 2 R.
  const double c = (1 - 0.13) / (2 * 6371000.0);
  const SightLine tilted = SightLines(tin, earth).between({1000, 100, 1}, {9000, 100, 2});
  EXPECT_NEAR(tilted.critical.x, 1000 + 8000 * (0.5 - 1 / (2 * c * 8000.0 * 8000.0)), 1e-6);
}

TEST(SightLines, SeesAcrossGroundWithoutData) {
  const Tin tin = ridge();
  const SightLine line = SightLines(tin, Earth::flat()).between({500, 0, -5}, {600, 0, -5});
  EXPECT_EQ(line.clearance, std::nullopt);
  EXPECT_TRUE(line.visible());
  const Tin nothing;
  EXPECT_TRUE(SightLines(nothing, Earth::flat()).between({0, 0, 0}, {1, 1, 1}).visible());
}

TEST(SightLines, OfLengthZeroLooksDown) {
  const Tin tin = ridge();
  const SightLines sight_lines(tin, Earth::flat());
  EXPECT_DOUBLE_EQ(*sight_lines.between({25, 30, 6}, {25, 30, 6}).clearance, 1);
  EXPECT_DOUBLE_EQ(*sight_lines.between({25, 30, 9}, {25, 30, 6}).clearance, 1);
  EXPECT_EQ(sight_lines.between({25, 30, 6}, {25, 30, 6}).length, 0);
  EXPECT_FALSE(sight_lines.between({25, 30, 4}, {25, 30, 4}).visible());
}

TEST(SightLines, WithinAStepOfTheGridOnlyTheEndsMatter) {
  // A wall of 50 m between two posts that are neighbours on the grid.
  const Tin tin = lattice(3, 3, 0.01, [](int c, int) { return c == 1 ? 50.0 : 0.0; });
  const SightLines sight_lines(tin, Earth::flat());
  const Point3 low{0.0005, 0.01, 3}, high{0.0095, 0.01, 48};
  EXPECT_TRUE(sight_lines.between(low, high).visible());
  // The wall rises by 5 km in a metre.
  EXPECT_NEAR(*sight_lines.between(low, high).clearance, 0.5, 1e-4);
  EXPECT_EQ(sight_lines.between(low, high).clearance, sight_lines.between(high, low).clearance);
  EXPECT_FALSE(sight_lines.between({0.0005, 0.01, 3}, {0.0195, 0.01, 3}).visible());
}

/// Rough ground, and ends of all kinds on and beside it.
class RandomSights : public ::testing::Test {
 protected:
  static constexpr int kPosts = 24;
  static constexpr double kSpacing = 100;

  void SetUp() override {
    random_.seed(seed());
    std::normal_distribution<double> height(100, 20);
    tin_ = lattice(kPosts, kPosts, kSpacing, [&](int, int) { return height(random_); });
  }

  Point3 end() {
    std::uniform_int_distribution<int> kind(0, 2), post(0, kPosts);
    std::uniform_real_distribution<double> place(-200, kPosts * kSpacing + 200), elevation(60, 240);
    if (kind(random_) > 0) return {place(random_), place(random_), elevation(random_)};
    return {post(random_) * kSpacing, post(random_) * kSpacing, elevation(random_)};
  }

  std::mt19937 random_;
  Tin tin_;
};

TEST_F(RandomSights, AreTheSameFromEitherEnd) {
  const SightLines sight_lines(tin_, Earth{});
  for (int i = 0; i < 2000; ++i) {
    const Point3 a = end(), b = end();
    const SightLine there = sight_lines.between(a, b), back = sight_lines.between(b, a);
    ASSERT_EQ(there.clearance.has_value(), back.clearance.has_value());
    if (!there.clearance) continue;
    ASSERT_TRUE(same_bits(*there.clearance, *back.clearance));
    ASSERT_EQ(there.critical, back.critical);
    ASSERT_TRUE(same_bits(there.length, back.length));
  }
}

/// The surface at (x, y), by asking every triangle.
struct Ground {
  std::uint32_t triangle = 0;
  double z = 0;
};
std::optional<Ground> ground_by_search(const Tin& tin, double x, double y) {
  for (std::uint32_t t = 0; t < tin.triangles.size(); ++t) {
    const Triangle& triangle = tin.triangles[t];
    const Point3 a = tin.point(triangle[0]), b = tin.point(triangle[1]), c = tin.point(triangle[2]);
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const double wb = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
    const double wc = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
    if (wb >= 0 && wc >= 0 && wb + wc <= 1) return Ground{t, a.z + wb * (b.z - a.z) + wc * (c.z - a.z)};
  }
  return std::nullopt;
}

TEST_F(RandomSights, AgreeWithDenseSampling) {
  const double k = 0.13, radius = 6371000;
  const SightLines sight_lines(tin_, Earth{});
  constexpr int kSamples = 2000;
  for (int i = 0; i < 20; ++i) {
    const Point3 a = end(), b = end();
    const SightLine line = sight_lines.between(a, b);
    double least = std::numeric_limits<double>::infinity();
    for (int s = 0; s <= kSamples; ++s) {
      const double t = static_cast<double>(s) / kSamples;
      const double x = a.x + t * (b.x - a.x), y = a.y + t * (b.y - a.y);
      const std::optional<Ground> ground = ground_by_search(tin_, x, y);
      if (!ground) continue;
      const double d = t * line.length, rest = line.length - d;
      least = std::min(least, a.z + t * (b.z - a.z) - ground->z - d * rest * (1 - k) / (2 * radius));
    }
    if (!std::isfinite(least)) continue;
    ASSERT_TRUE(line.clearance);
    // Between two samples clearance changes by at most their distance times the steepest slope there is.
    const double slack = line.length / kSamples * 3;
    // Ends are rounded to 2^-20 grid steps (section_line.hpp), and the ground is at most this steep.
    const double rounding = 3 * tin_.grid.resolution / (1 << 20);
    EXPECT_LE(*line.clearance, least + rounding + 1e-9);
    EXPECT_GE(*line.clearance, least - slack);
  }
}

TEST_F(RandomSights, FindEveryTriangleTheyCross) {
  const TriangleBuckets buckets(tin_);
  for (int i = 0; i < 200; ++i) {
    const Point3 a = end(), b = end();
    const std::vector<std::uint32_t> near = buckets.near({a.x, a.y}, {b.x, b.y});
    EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
    for (int s = 0; s <= 100; ++s) {
      const double t = s / 100.0;
      const auto ground = ground_by_search(tin_, a.x + t * (b.x - a.x), a.y + t * (b.y - a.y));
      if (!ground) continue;
      ASSERT_TRUE(std::binary_search(near.begin(), near.end(), ground->triangle));
    }
  }
}

}  // namespace

}  // namespace itin::test
