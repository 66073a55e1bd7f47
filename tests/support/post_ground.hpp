// Grounds of posts at random for tests of levels, and an index over them.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "geometry/post_lattice.hpp"
#include "support/points.hpp"

namespace itin::test {

inline const std::vector<std::int32_t> kHierarchyTolerances{0, 30, 60, 120, 600};

/// A raster with hills and perhaps holes; and perhaps points and a line that are none of its posts.
struct PostGround {
  std::int32_t step = 10, columns = 0, rows = 0;
  LatticePlace first;  ///< on the lattice from position 0, 0
  std::map<Position, std::int32_t> heights;
  std::vector<GridPoint> strays;
  std::vector<Segment> lines;

  Position at(std::int64_t column, std::int64_t row) const {
    return {static_cast<std::int32_t>(column * step), static_cast<std::int32_t>(row * step)};
  }
  std::int64_t east() const { return first.column + columns - 1; }
  std::int64_t north() const { return first.row + rows - 1; }
};

/// `columns`: how many; by default at random.
inline PostGround random_ground(unsigned seed, int columns = 0) {
  std::mt19937 random(seed);
  const auto draw = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  PostGround ground;
  ground.step = draw(3, 40);
  ground.columns = draw(70, 150), ground.rows = draw(70, 150);
  if (columns > 0) ground.columns = columns;
  ground.first = {draw(-200, 200), draw(-200, 200)};
  const double scale = draw(20, 200) / 10.0;
  const int rough = draw(0, 60), gaps = std::array{0, 1, 40}[static_cast<std::size_t>(draw(0, 2))];
  for (std::int64_t r = ground.first.row; r <= ground.north(); ++r) {
    for (std::int64_t c = ground.first.column; c <= ground.east(); ++c) {
      const double hill =
          400 * std::sin(static_cast<double>(c) / scale) * std::cos(static_cast<double>(r) / scale / 1.3);
      const bool flat = c % 50 < 20;
      if (draw(0, 999) >= gaps) ground.heights[ground.at(c, r)] = static_cast<int>(flat ? 7 : hill) + draw(0, rough);
    }
  }
  const auto anywhere = [&] {
    return Position{ground.at(ground.first.column, 0).x + draw(0, ground.columns * ground.step),
                    ground.at(0, ground.first.row).y + draw(0, ground.rows * ground.step)};
  };
  if (draw(0, 1) == 0) {
    for (int i = draw(1, 5); i > 0; --i) {
      const Position p = anywhere();
      if (!ground.heights.contains(p)) ground.strays.push_back({p.x, p.y, 0});
    }
  }
  if (draw(0, 1) == 0) {
    const Position a = anywhere(), b = anywhere();
    if (a != b) ground.lines.push_back({a.x, a.y, b.x, b.y, 1});
  }
  return ground;
}

inline TestIndex index_of(const PostGround& ground) {
  std::vector<test::LevelPoint> points;
  for (const auto& [p, height] : ground.heights) points.push_back({{p.x, p.y, height}, 0});
  for (const GridPoint& p : ground.strays) points.push_back({p, 0});
  TestIndex index(points, static_cast<int>(kHierarchyTolerances.size()), 64);
  index->set_segments(ground.lines);
  return index;
}

inline std::map<Position, int> levels_in(const WorkingIndex& index) {
  std::map<Position, int> levels;
  for (const CurveRange& tile : index.tiles(1 << 30))
    for (const RawPoint& p : index.read(tile)) levels[position_of(p.code)] = p.level;
  return levels;
}

}  // namespace itin::test
