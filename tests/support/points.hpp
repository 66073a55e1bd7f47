// Sets of grid points for tests, made from a logged seed, and indices over them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>

#include "pyramid/points/sorted_points.hpp"
#include "pyramid/points/working_index.hpp"

namespace itin::test {

/// A point with the level it belongs to.
struct LevelPoint {
  GridPoint point;
  int level = 0;
};

enum class Pattern { kRandom, kLattice, kClusters, kContours, kCollinear, kCocircular, kGappyLattice, kTurnedLattice };

inline std::vector<GridPoint> make_points(Pattern pattern, int count, std::mt19937& random) {
  const auto below = [&](int n) { return static_cast<std::int32_t>(random() % static_cast<unsigned>(n)); };
  std::vector<GridPoint> points;
  const int side = std::max(2, static_cast<int>(std::sqrt(count)));
  for (int i = 0; i < count; ++i) {
    GridPoint p;
    switch (pattern) {
      case Pattern::kRandom:
        p = {below(100000), below(100000), 0};
        break;
      case Pattern::kLattice:
        p = {i % side * 50, i / side * 50, 0};
        break;
      case Pattern::kGappyLattice: {
        // The posts are in rectangles, rounded to the grid, with gaps and strays.
        const int column = i % side, row = i / side;
        p = {column * 50 + column / 3, row * 70 + row / 2, 0};
        if (below(40) == 0) p = {below(50 * side), below(70 * side), 0};
        break;
      }
      case Pattern::kTurnedLattice: {
        // The posts are rounded to the grid, so that those along the border are only nearly in line.
        const double column = i % side * 50.0, row = i / side * 50.0;
        p = {static_cast<std::int32_t>(std::lround(column * 0.956 - row * 0.292)),
             static_cast<std::int32_t>(std::lround(column * 0.292 + row * 0.956)), 0};
        break;
      }
      case Pattern::kClusters: {
        const int centre = below(5);
        p = {centre * 20000 + below(300) * below(30), centre * centre * 3000 + below(300) * below(30), 0};
        break;
      }
      case Pattern::kContours: {
        const double angle = below(1000) * 0.00628318, radius = 1000.0 * (1 + below(8));
        p = {static_cast<std::int32_t>(radius * std::cos(angle)), static_cast<std::int32_t>(radius * std::sin(angle)),
             0};
        break;
      }
      case Pattern::kCollinear:
        p = {below(50) * 10, below(3) * 700, 0};
        break;
      case Pattern::kCocircular: {
        // Pythagorean triples give many integer points on one circle.
        static constexpr std::array<std::array<int, 2>, 7> kLegs{
            {{65, 0}, {63, 16}, {60, 25}, {56, 33}, {52, 39}, {33, 56}, {16, 63}}};
        const auto& leg = kLegs[static_cast<std::size_t>(below(7))];
        const int circle = 1 + below(3);
        p = {(below(2) ? 1 : -1) * leg[0] * circle, (below(2) ? 1 : -1) * leg[1] * circle, 0};
        break;
      }
    }
    p.z = below(2000);
    points.push_back(p);
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end(),
                           [](const GridPoint& a, const GridPoint& b) { return a.x == b.x && a.y == b.y; }),
               points.end());
  return points;
}

/// A working index over points with given levels.
class TestIndex {
 public:
  TestIndex(const std::vector<LevelPoint>& points, int levels, std::uint32_t leaf_capacity) : sorted_(sort(points)) {
    index_ = std::make_unique<WorkingIndex>(sorted_, levels, leaf_capacity);
    for (const CurveRange& tile : index_->tiles(1 << 30)) index_->write(tile, index_->read(tile));
  }
  WorkingIndex& operator*() { return *index_; }
  WorkingIndex* operator->() { return index_.get(); }

 private:
  static SortedPoints sort(const std::vector<LevelPoint>& points) {
    PointSorter sorter("/tmp", 1 << 24);
    for (const LevelPoint& p : points) {
      sorter.add({morton(p.point.x, p.point.y), p.point.z, 0, static_cast<std::uint16_t>(p.level)});
    }
    NoProgress progress;
    const std::array sources{SourceRank{1.0}};
    return sorter.finish(sources, progress);
  }

  SortedPoints sorted_;
  std::unique_ptr<WorkingIndex> index_;
};

}  // namespace itin::test
