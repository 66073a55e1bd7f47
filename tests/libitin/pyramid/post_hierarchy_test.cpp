// Fine levels of rasters are those that the hierarchy's definition gives, whatever the tiles, and depend on the heights
// near by alone.
#include "pyramid/levels/post_hierarchy.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "pyramid/levels/cell_verification.hpp"
#include "pyramid/levels/fine_bounds.hpp"
#include "support/post_ground.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

using test::index_of, test::kHierarchyTolerances, test::levels_in, test::PostGround, test::random_ground;

/// The levels by their definition, found slowly.
class SlowHierarchy {
 public:
  explicit SlowHierarchy(const PostGround& ground)
      : ground_(ground), heights_(static_cast<std::size_t>(ground.columns) * static_cast<std::size_t>(ground.rows)) {
    for (std::int64_t r = ground.first.row; r <= ground.north(); ++r) {
      for (std::int64_t c = ground.first.column; c <= ground.east(); ++c) {
        const auto height = ground.heights.find(ground.at(c, r));
        if (height != ground.heights.end()) heights_[post(c, r)] = height->second;
        if (c < ground.east() && r < ground.north() && is_sound_single(c, r)) sound_.insert({c, r});
      }
    }
    for (std::size_t k = 1; k < kHierarchyTolerances.size(); ++k) select(static_cast<int>(k));
    choose_coarsest();
  }

  int coarsest() const { return coarsest_; }
  /// The level of each post of a sound square.
  std::map<Position, int> levels() const {
    std::map<Position, int> result;
    for (const auto& [place, level] : levels_)
      result[ground_.at(place.first, place.second)] = std::min(level, coarsest_);
    return result;
  }

 private:
  using Place = std::pair<std::int64_t, std::int64_t>;

  std::size_t post(std::int64_t c, std::int64_t r) const {
    return static_cast<std::size_t>((r - ground_.first.row) * ground_.columns + c - ground_.first.column);
  }
  double z(std::int64_t c, std::int64_t r) const { return heights_[post(c, r)]; }

  bool is_sound_single(std::int64_t c, std::int64_t r) const {
    for (const Position p : {ground_.at(c, r), ground_.at(c + 1, r), ground_.at(c, r + 1), ground_.at(c + 1, r + 1)})
      if (!ground_.heights.contains(p)) return false;
    const Position low = ground_.at(c, r), high = ground_.at(c + 1, r + 1);
    const GridBox box{low.x, low.y, high.x, high.y};
    const auto touches = [&](const Segment& s) {
      if (!extent_of(s).meets(box)) return false;
      int left = 0, right = 0;
      for (const Position p : {low, high, Position{low.x, high.y}, Position{high.x, low.y}}) {
        left += orientation(s.a(), s.b(), p) >= 0;
        right += orientation(s.a(), s.b(), p) <= 0;
      }
      return left > 0 && right > 0;
    };
    return std::none_of(ground_.strays.begin(), ground_.strays.end(),
                        [&](const GridPoint& p) { return box.contains(p.x, p.y); }) &&
           std::none_of(ground_.lines.begin(), ground_.lines.end(), touches);
  }
  bool is_sound(std::int64_t west, std::int64_t south, std::int64_t side) const {
    for (std::int64_t r = south; r < south + side; ++r)
      for (std::int64_t c = west; c < west + side; ++c)
        if (!sound_.contains({c, r})) return false;
    return true;
  }
  static std::int64_t down(std::int64_t v, std::int64_t side) { return floor_divide(v, side) * side; }

  /// The full surface at a place of half steps.
  double full(double x, double y) const {
    const double c = std::min<double>(std::floor(x), static_cast<double>(ground_.east()) - 1),
                 r = std::min<double>(std::floor(y), static_cast<double>(ground_.north()) - 1);
    const double u = x - c, v = y - r;
    const auto west = static_cast<std::int64_t>(c), south = static_cast<std::int64_t>(r);
    if (u + v <= 1) {
      double height = z(west, south) * (1 - u - v);
      if (u > 0) height += z(west + 1, south) * u;
      if (v > 0) height += z(west, south + 1) * v;
      return height;
    }
    return z(west + 1, south + 1) * (u + v - 1) + z(west, south + 1) * (1 - u) + z(west + 1, south) * (1 - v);
  }

  /// Whether a triangle of posts is too far off the full surface, at a post or at a crossing of edges. Places of half
  /// steps have them all.
  bool fails(const std::array<Place, 3>& corners, std::int32_t tolerance) const {
    const auto& [a, b, c] = corners;
    const double ax = static_cast<double>(a.first), ay = static_cast<double>(a.second);
    const double bx = static_cast<double>(b.first) - ax, by = static_cast<double>(b.second) - ay,
                 cx = static_cast<double>(c.first) - ax, cy = static_cast<double>(c.second) - ay;
    const double area = bx * cy - by * cx;
    const auto [west, east] = std::minmax({a.first, b.first, c.first});
    const auto [south, north] = std::minmax({a.second, b.second, c.second});
    for (double y = static_cast<double>(south); y <= static_cast<double>(north); y += 0.5) {
      for (double x = static_cast<double>(west); x <= static_cast<double>(east); x += 0.5) {
        const double q = ((x - ax) * cy - (y - ay) * cx) / area, t = (bx * (y - ay) - by * (x - ax)) / area;
        if (q < 0 || t < 0 || q + t > 1) continue;
        const bool post = x == std::floor(x) && y == std::floor(y), edge = q == 0 || t == 0 || q + t == 1;
        if (!post && !edge) continue;
        const double plane = z(a.first, a.second) * (1 - q - t) + z(b.first, b.second) * q + z(c.first, c.second) * t;
        const double off = std::abs(full(x, y) - plane);
        if (off > tolerance || (!post && off >= tolerance)) return true;
      }
    }
    return false;
  }

  void select(int level) {
    std::vector<Place> open;
    const auto take = [&](const Place& p) {
      int& known = levels_[p];
      if (known < level) known = level, open.push_back(p);
    };
    for (const Place& square : sound_) {
      for (const Place& p : {square, Place{square.first + 1, square.second}, Place{square.first, square.second + 1},
                             Place{square.first + 1, square.second + 1}})
        levels_.try_emplace(p, 0);
      for (std::int64_t side = 1; side <= 64; side *= 2) {
        const std::int64_t c = down(square.first, side), r = down(square.second, side);
        if (!is_sound(c, r, side) || (side < 64 && is_sound(down(c, 2 * side), down(r, 2 * side), 2 * side))) continue;
        for (const Place& corner : {Place{c, r}, Place{c + side, r}, Place{c, r + side}, Place{c + side, r + side}})
          take(corner);
      }
    }
    const std::vector<std::pair<Place, int>> posts(levels_.begin(), levels_.end());
    for (const auto& [place, known] : posts)
      if (known < level && square_fails(place, kHierarchyTolerances[static_cast<std::size_t>(level)])) take(place);
    while (!open.empty()) {
      const Place p = open.back();
      open.pop_back();
      for (const Place& corner : corners(p)) take(corner);
    }
  }

  /// The size and the kind of a post's square by the least power of two that either coordinate is no multiple of.
  static std::int64_t half_of(const Place& p) {
    for (std::int64_t side = 2; side <= 64; side *= 2)
      if (p.first % side != 0 || p.second % side != 0) return side / 2;
    return 0;
  }

  std::vector<Place> corners(const Place& p) const {
    const auto [c, r] = p;
    const std::int64_t h = half_of(p);
    std::vector<Place> result;
    if (h == 0) return result;
    const bool off_column = c % (2 * h) != 0, off_row = r % (2 * h) != 0;
    if (off_column && off_row) {
      if (is_sound(c - h, r - h, 2 * h)) result = {{c - h, r - h}, {c + h, r - h}, {c - h, r + h}, {c + h, r + h}};
      return result;
    }
    for (const std::int64_t way : {-h, h}) {
      const Place centre = off_column ? Place{c, r + way} : Place{c + way, r};
      if (!is_sound(centre.first - h, centre.second - h, 2 * h)) continue;
      result.push_back(centre);
      result.push_back(off_column ? Place{c - h, r} : Place{c, r - h});
      result.push_back(off_column ? Place{c + h, r} : Place{c, r + h});
    }
    return result;
  }

  bool square_fails(const Place& p, std::int32_t tolerance) const {
    if (half_of(p) == 0) return false;
    const std::vector<Place> needed = corners(p);
    const std::set<Place> all(needed.begin(), needed.end());
    // Of four corners in a square each three make a half of it; of three corners only they do.
    const std::vector<Place> square(all.begin(), all.end());
    if (square.size() == 3) return fails({square[0], square[1], square[2]}, tolerance);
    for (std::size_t left_out = 0; left_out < square.size(); ++left_out) {
      std::vector<Place> three = square;
      three.erase(three.begin() + static_cast<std::ptrdiff_t>(left_out));
      if (fails({three[0], three[1], three[2]}, tolerance)) return true;
    }
    return false;
  }

  void choose_coarsest() {
    for (int k = static_cast<int>(kHierarchyTolerances.size()) - 1; k > 0; --k) {
      const auto selected = std::count_if(levels_.begin(), levels_.end(), [&](const auto& p) { return p.second >= k; });
      if (2 * static_cast<std::size_t>(selected) < levels_.size()) continue;
      coarsest_ = k;
      return;
    }
  }

  const PostGround& ground_;
  std::vector<double> heights_;  ///< by post
  std::set<Place> sound_;        ///< single squares, by their lower left posts
  std::map<Place, int> levels_;
  int coarsest_ = 0;
};

TEST(PostHierarchies, GiveTheLevelsOfTheirDefinitionWhateverTheTiles) {
  NoProgress progress;
  std::mt19937 random(test::seed());
  int fine = 0;
  for (unsigned round = 0; round < 12; ++round) {
    SCOPED_TRACE(round);
    const PostGround ground = random_ground(test::seed() + round);
    const SlowHierarchy slow(ground);
    fine += slow.coarsest() > 0 ? 1 : 0;
    const std::map<Position, int> expected = slow.levels();
    for (const std::uint32_t capacity : {1U << 11, 1U << 18}) {
      test::TestIndex index = index_of(ground);
      std::map<Position, int> given;
      for (int i = 0; i < 20; ++i) {
        const auto post = std::next(ground.heights.begin(), static_cast<int>(random() % ground.heights.size()));
        given[post->first] = static_cast<int>(1 + random() % 4);
      }
      for (const auto& [p, level] : given) index->promote({{code_of(p), level}});
      const PostHierarchy hierarchy(*index, index->tiles(capacity), kHierarchyTolerances, progress);
      EXPECT_EQ(hierarchy.coarsest_level(), slow.coarsest());
      for (const auto& [p, level] : levels_in(*index)) {
        const auto found = expected.find(p);
        const int least = given.contains(p) ? given.at(p) : 0;
        ASSERT_EQ(level, std::max(least, found == expected.end() ? 0 : found->second)) << p.x << ' ' << p.y;
        if (slow.coarsest() == 0) continue;
        ASSERT_EQ(hierarchy.has(p), found != expected.end()) << p.x << ' ' << p.y;
      }
    }
  }
  EXPECT_GT(fine, 0) << "none of these grounds has fine levels";
}

/// At this raster's end the fullest leaves of a tile have one column of posts, and do not know the step between
/// columns.
TEST(PostHierarchies, LeaveNoTileOut) {
  NoProgress progress;
  PostGround ground = random_ground(341);
  ground.lines.clear();
  const SlowHierarchy slow(ground);
  ASSERT_GT(slow.coarsest(), 0);
  test::TestIndex index = index_of(ground);
  const PostHierarchy hierarchy(*index, index->tiles(1U << 12), kHierarchyTolerances, progress);
  const std::map<Position, int> expected = slow.levels();
  for (const auto& [p, level] : levels_in(*index)) {
    const auto found = expected.find(p);
    ASSERT_EQ(level, found == expected.end() ? 0 : found->second) << p.x << ' ' << p.y;
  }
}

TEST(PostHierarchies, StayClosedWherePostsAreRaised) {
  NoProgress progress;
  std::mt19937 random(test::seed());
  for (unsigned round = 0; round < 12; ++round) {
    SCOPED_TRACE(round);
    const PostGround ground = random_ground(test::seed() + 100 + round);
    test::TestIndex index = index_of(ground);
    const PostHierarchy hierarchy(*index, index->tiles(1 << 18), kHierarchyTolerances, progress);
    std::vector<LevelRaise> raises;
    for (int i = 0; i < 20; ++i) {
      const auto& [p, height] = *std::next(ground.heights.begin(), static_cast<int>(random() % ground.heights.size()));
      raises.push_back({code_of(p), static_cast<int>(1 + random() % 4)});
    }
    index->promote(raises);
    index->promote(hierarchy.closing(raises));
    // Nothing is missing any more.
    std::vector<LevelRaise> all;
    for (const auto& [p, level] : levels_in(*index))
      if (level > 0) all.push_back({code_of(p), level});
    EXPECT_TRUE(index->promote(hierarchy.closing(all)).empty());
  }
}

TEST(PostHierarchies, DependOnHeightsNearByAlone) {
  NoProgress progress;
  for (unsigned round = 0; round < 6; ++round) {
    SCOPED_TRACE(round);
    PostGround ground = random_ground(test::seed() + 200 + round);
    ground.lines.clear(), ground.strays.clear();
    const auto levels = [&] {
      test::TestIndex index = index_of(ground);
      const PostHierarchy hierarchy(*index, index->tiles(1 << 18), kHierarchyTolerances, progress);
      return std::pair(hierarchy.coarsest_level(), levels_in(*index));
    };
    const auto before = levels();
    const std::int64_t end = ground.first.column + 10;
    for (auto& [p, height] : ground.heights)
      if (p.x <= end * ground.step) height = height % 37 * 11;
    const auto after = levels();
    if (before.first != after.first) continue;  // the choice of fine levels is of the whole
    for (const auto& [p, level] : before.second) {
      if (p.x <= (end + PostHierarchy::kReach) * ground.step) continue;
      ASSERT_EQ(after.second.at(p), level) << p.x << ' ' << p.y;
    }
  }
}

/// Adds points that lie close to a side of a single square, within the circle of the square beyond. Returns where.
std::set<Position> add_points_beside_sides(PostGround& ground, unsigned seed) {
  std::mt19937 random(seed);
  const auto draw = [&](std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random);
  };
  constexpr std::int64_t kFromEdge = 5;  // so that none belongs to the outline of the ground
  std::set<Position> added;
  for (int i = 0; i < 20; ++i) {
    Position p = ground.at(draw(ground.first.column + kFromEdge, ground.east() - kFromEdge),
                           draw(ground.first.row + kFromEdge, ground.north() - kFromEdge));
    p.x += ground.step / 2, p.y += std::max(1, ground.step / 10);
    if (added.insert(p).second) ground.strays.push_back({p.x, p.y, static_cast<std::int32_t>(draw(-500, 500))});
  }
  return added;
}

/// Expects that what is measured by squares holds what triangulation finds, and keeps to the tolerance. Fine levels
/// lack the points at `lacking`. Returns the number of leaves that were measured.
std::size_t expect_bounds_hold(const PostGround& ground, unsigned seed, const std::set<Position>& lacking) {
  NoProgress progress;
  test::TestIndex index = index_of(ground);
  const std::vector<CurveRange> tiles = index->tiles(1 << 12), whole = index->tiles(1 << 30);
  const PostHierarchy hierarchy(*index, tiles, kHierarchyTolerances, progress);
  if (hierarchy.coarsest_level() == 0) return 0;
  // Other levels than the fine ones have raised some posts, and all other points beside the hierarchy.
  std::mt19937 random(seed);
  std::vector<LevelRaise> raises;
  for (int i = 0; i < 5; ++i)
    raises.push_back({code_of(std::next(ground.heights.begin(), static_cast<int>(random() % 4000))->first), 4});
  for (const auto& [p, level] : levels_in(*index))
    if (!hierarchy.has(p) && !lacking.contains(p)) raises.push_back({code_of(p), 4});
  index->promote(raises);
  index->promote(hierarchy.closing(raises));
  const int levels = static_cast<int>(kHierarchyTolerances.size());
  LeafBounds bounds(index->ranges().size(), levels), found(index->ranges().size(), levels);
  const std::vector<unsigned> known = measure_fine_levels(*index, tiles, hierarchy, bounds, progress);
  for (const CurveRange& cell : whole) {
    const Task task{cell, square_of(cell.cell), (2U << hierarchy.coarsest_level()) - 2};
    verify_cell(*index, kHierarchyTolerances, task, false, nullptr, found);
  }
  std::size_t known_leaves = 0;
  for (std::uint32_t leaf = 0; leaf < known.size(); ++leaf) {
    for (int k = 1; k < levels; ++k) {
      if (!(known[leaf] >> k & 1)) continue;
      ++known_leaves;
      const DifferenceRange measured = bounds.at(leaf, k), of_triangles = found.at(leaf, k);
      EXPECT_FALSE(of_triangles.empty());
      EXPECT_LE(measured.lo, of_triangles.lo) << "level " << k;
      EXPECT_GE(measured.hi, of_triangles.hi) << "level " << k;
      EXPECT_LE(measured.size(), kHierarchyTolerances[static_cast<std::size_t>(k)]);
    }
  }
  return known_leaves;
}

TEST(FineBounds, HoldWhatTriangulationFinds) {
  std::size_t known_leaves = 0;
  for (unsigned round = 0; round < 12; ++round) {
    SCOPED_TRACE(round);
    PostGround ground = random_ground(test::seed() + 300 + round);
    ground.lines.clear();  // their ends would have to be vertices
    known_leaves += expect_bounds_hold(ground, test::seed() + round, {});
  }
  EXPECT_GT(known_leaves, 0U);
}

/// The full surface has the points that a level lacks, and other triangles in all squares whose circles hold one.
TEST(FineBounds, HoldBesidePointsThatTheLevelLacks) {
  std::size_t known_leaves = 0;
  for (unsigned round = 0; round < 12; ++round) {
    SCOPED_TRACE(round);
    PostGround ground = random_ground(test::seed() + 400 + round);
    ground.lines.clear(), ground.strays.clear();
    const std::set<Position> added = add_points_beside_sides(ground, test::seed() + round);
    known_leaves += expect_bounds_hold(ground, test::seed() + round, added);
  }
  EXPECT_GT(known_leaves, 0U);
}

}  // namespace
}  // namespace itin
