// A surface with features against the bare one.
#pragma once

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include "features/mesh/terrain_heights.hpp"

namespace itin::test {

/// How steep a triangulation is about a position: roundings of positions to the grid cost so many heights.
inline double slope_of(const Tin& tin, const Triangle& t) {
  const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
  const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z, vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
  return std::hypot(nx, ny) / nz;
}

/// The surface of a choice of themes against the bare one.
class SurfaceComparison {
 public:
  SurfaceComparison(const Tin& bare, const Tin& themed) : bare_(bare), themed_(themed), low_(bare), high_(themed) {
    for (const Triangle& t : bare.triangles) steepest_ = std::max(steepest_, slope_of(bare, t));
  }

  /// Rounding: a grid step of heights, and on the steepest slope half a step aside in x and in y, twice: lines are made
  /// planar by themselves, and then with all others.
  double allowed() const { return bare_.grid.resolution * (1 + std::sqrt(2) * steepest_); }

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

}  // namespace itin::test
