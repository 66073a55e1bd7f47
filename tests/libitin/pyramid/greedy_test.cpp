// Every level that greedy insertion proposes keeps to its tolerance, and a lattice's levels and ground are those that
// are found triangle by triangle, or as good.
#include "pyramid/greedy/greedy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <itin/detail.hpp>

#include "pyramid/coverage/coverage.hpp"
#include "pyramid/coverage/ground_edges.hpp"
#include "pyramid/difference/overlay.hpp"
#include "support/covered_index.hpp"
#include "support/points.hpp"
#include "support/raster_file.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

const std::vector<double> kGreedyTolerances{0, 20, 80, 400};

Selection greedy_level(std::size_t k) {
  return {Detail::tolerance(kGreedyTolerances[k]), kGreedyTolerances, Grid{}};
}

class Greedy : public testing::Test {
 protected:
  using Height = std::function<std::int32_t(std::int32_t, std::int32_t)>;
  using Levels = std::vector<std::uint8_t>;
  static constexpr std::int32_t kColumns = 45, kRows = 37;

  std::int32_t draw(std::int32_t low, std::int32_t high) {
    return std::uniform_int_distribution<std::int32_t>(low, high)(random_);
  }

  /// Posts from the lower left one on, whose position is {west, south}.
  std::vector<test::LevelPoint> posts(const Height& height, double share = 1) {
    std::vector<test::LevelPoint> points;
    for (std::int32_t r = 0; r < kRows; ++r) {
      for (std::int32_t c = 0; c < kColumns; ++c) {
        if (draw(1, 1000) <= 1000 * share)
          points.push_back({{west_ + c * step_x_, south_ + r * step_y_, height(c, r)}, 0});
      }
    }
    return points;
  }

  /// Hills of some kind, rough enough for all levels.
  Height hills() {
    const double u = draw(5, 30) / 10.0, v = draw(5, 30) / 10.0;
    return [=, this](std::int32_t c, std::int32_t r) {
      return static_cast<std::int32_t>(900 * std::sin(c / u / 4) * std::cos(r / v / 3)) + draw(-60, 60);
    };
  }

  static RegionMesh surface(test::TestIndex& index, std::size_t level) {
    return triangulate_region(*index, greedy_level(level), index->bounds());
  }
  /// Every vertex may get a level.
  static std::vector<Candidacy> all_of(const RegionMesh& fine) {
    return std::vector<Candidacy>(fine.vertices.size(), Candidacy::kFree);
  }

  /// Whether two posts are ends of a side of the lattice's triangles.
  bool is_side(Position p, Position q) const {
    const std::int64_t x = (std::int64_t{q.x} - p.x) / step_x_, y = (std::int64_t{q.y} - p.y) / step_y_;
    const auto is = [&](std::int64_t dx, std::int64_t dy) { return (x == dx && y == dy) || (x == -dx && y == -dy); };
    return is(1, 0) || is(0, 1) || is(1, -1);
  }

  /// Where `sides_only`, what other edges of the full surface say does not count.
  void expect_kept(const RegionMesh& fine, const Levels& levels, bool sides_only = false) {
    std::vector<test::LevelPoint> points;
    for (std::size_t v = 0; v < levels.size(); ++v) points.push_back({fine.vertices[v].point, levels[v]});
    test::TestIndex index(points, static_cast<int>(kGreedyTolerances.size()), 64);
    const FineEdges edges(fine);
    for (std::size_t k = 1; k < kGreedyTolerances.size(); ++k) {
      const auto failures =
          difference(fine, edges, surface(index, k), static_cast<std::int32_t>(kGreedyTolerances[k])).failures;
      ASSERT_TRUE(failures.worst_of_faces.empty()) << "level " << k;
      const auto counts = [&](const FailingCrossing& c) {
        return !sides_only || is_side(position_of(c.vertices[0]), position_of(c.vertices[1]));
      };
      ASSERT_TRUE(std::none_of(failures.crossings.begin(), failures.crossings.end(), counts)) << "level " << k;
    }
  }

  static Levels levels_of_posts(const RegionMesh& fine) {
    const auto posts = LatticePosts::of(fine.vertices);
    if (!posts) throw std::logic_error("no lattice");
    return greedy_levels(fine.vertices, *posts, all_of(fine), kGreedyTolerances);
  }

  /// How many vertices level k has.
  static double size_of_level(const Levels& levels, std::uint8_t k) {
    return static_cast<double>(std::count_if(levels.begin(), levels.end(), [&](std::uint8_t l) { return l >= k; }));
  }

  static std::vector<std::pair<Segment, std::uint64_t>> sorted(const GroundEdges& ground) {
    std::vector<std::pair<Segment, std::uint64_t>> edges;
    for (const auto& [segment, owner] : ground.edges) edges.emplace_back(segment, owner);
    std::sort(edges.begin(), edges.end());
    return edges;
  }

  std::mt19937 random_{test::seed()};
  std::int32_t west_ = -4321, south_ = 987, step_x_ = 50, step_y_ = 50;
};

TEST_F(Greedy, KeepsToTolerancesOverScatteredPoints) {
  using test::Pattern;
  for (const Pattern pattern : {Pattern::kRandom, Pattern::kClusters, Pattern::kTurnedLattice, Pattern::kCocircular}) {
    std::vector<test::LevelPoint> points;
    for (const GridPoint& p : test::make_points(pattern, 900, random_)) points.push_back({p, 0});
    test::TestIndex index(points, 1, 64);
    const RegionMesh fine = surface(index, 0);
    expect_kept(fine, greedy_levels(fine, all_of(fine), kGreedyTolerances));
  }
}

TEST_F(Greedy, KeepsToTolerancesOverLattices) {
  const test::CardiffTerrain terrain;
  const std::vector<Height> grounds{
      hills(), [&](std::int32_t c, std::int32_t r) { return static_cast<std::int32_t>(100 * terrain(c + 90, r + 80)); },
      [](std::int32_t c, std::int32_t r) { return 7 * c - 5 * r; }, [](auto, auto) { return 12; }};
  for (const Height& height : grounds) {
    step_x_ = draw(1, 60), step_y_ = draw(1, 60);
    test::TestIndex index(posts(height), 1, 64);
    const RegionMesh fine = surface(index, 0);
    ASSERT_EQ(fine.vertices.size(), kColumns * kRows);
    const Levels of_lattice = levels_of_posts(fine);
    expect_kept(fine, of_lattice);
    const Levels of_mesh = greedy_levels(fine, all_of(fine), kGreedyTolerances);
    expect_kept(fine, of_mesh);
    for (const std::uint8_t k : {1, 2, 3})
      EXPECT_NEAR(size_of_level(of_lattice, k), size_of_level(of_mesh, k), 10 + 0.1 * size_of_level(of_mesh, k));
  }
}

TEST_F(Greedy, KeepsToTolerancesAtPostsAndSidesOfLatticesWithGaps) {
  for (const double share : {0.99, 0.9, 0.8}) {
    step_y_ = draw(20, 90);
    test::TestIndex index(posts(hills(), share), 1, 64);
    const RegionMesh fine = surface(index, 0);
    const Levels levels = levels_of_posts(fine);
    EXPECT_GT(size_of_level(levels, 1), size_of_level(levels, 3));
    expect_kept(fine, levels, true);
  }
}

TEST_F(Greedy, TakesSpareVerticesOnlyWhereNoFreeOneWouldDo) {
  step_x_ = step_y_ = 40;
  std::vector<test::LevelPoint> scattered;
  for (const GridPoint& p : test::make_points(test::Pattern::kRandom, 900, random_)) scattered.push_back({p, 0});
  for (const std::vector<test::LevelPoint>& points : {posts(hills()), scattered}) {
    test::TestIndex index(points, 1, 64);
    const RegionMesh fine = surface(index, 0);
    std::vector<Candidacy> candidacy = all_of(fine);
    for (Candidacy& c : candidacy) c = draw(0, 1) == 0 ? Candidacy::kSpare : Candidacy::kFree;
    const auto lattice = LatticePosts::of(fine.vertices);
    const Levels levels = lattice ? greedy_levels(fine.vertices, *lattice, candidacy, kGreedyTolerances)
                                  : greedy_levels(fine, candidacy, kGreedyTolerances);
    expect_kept(fine, levels);
    std::size_t spare = 0, free = 0;
    for (std::size_t v = 0; v < levels.size(); ++v)
      if (levels[v] >= 2) (candidacy[v] == Candidacy::kSpare ? spare : free) += 1;
    EXPECT_TRUE(!lattice || 2 * spare < free);
  }
}

TEST_F(Greedy, LeavesLevelsFinerThanAskedForAsTheyAre) {
  test::TestIndex index(posts(hills()), 1, 64);
  const RegionMesh fine = surface(index, 0);
  const Levels all = levels_of_posts(fine);
  Levels coarse = all;
  for (std::uint8_t& level : coarse)
    if (level < 2) level = 0;
  EXPECT_EQ(greedy_levels(fine.vertices, *LatticePosts::of(fine.vertices), all_of(fine), kGreedyTolerances, 2), coarse);
}

TEST_F(Greedy, KeepsLevelsThatAreGiven) {
  std::vector<test::LevelPoint> points = posts([](auto, auto) { return 0; });
  for (test::LevelPoint& p : points) p.level = draw(0, 40) == 0 ? draw(1, 3) : 0;
  test::TestIndex index(points, static_cast<int>(kGreedyTolerances.size()), 64);
  const RegionMesh fine = surface(index, 0);
  const Levels levels = levels_of_posts(fine);
  ASSERT_EQ(levels, greedy_levels(fine, all_of(fine), kGreedyTolerances));
  for (std::size_t v = 0; v < levels.size(); ++v) EXPECT_GE(levels[v], fine.vertices[v].level);
  EXPECT_GT(size_of_level(levels, 1), 8);
}

TEST_F(Greedy, TakesScatteredPointsForNoLattice) {
  const auto are_posts = [](const std::vector<test::LevelPoint>& points) {
    std::vector<SelectedVertex> vertices;
    for (const test::LevelPoint& p : points) vertices.push_back({p.point});
    return LatticePosts::of(vertices).has_value();
  };
  std::vector<test::LevelPoint> points = posts(hills(), 0.9);
  EXPECT_TRUE(are_posts(points));
  points.push_back({{west_ + 1, south_ + 1, 0}, 0});
  EXPECT_FALSE(are_posts(points));
  EXPECT_FALSE(are_posts(posts(hills(), 0.3)));  // mostly empty
  EXPECT_FALSE(are_posts({}));
  EXPECT_TRUE(are_posts({points[0]}));
}

/// Ground of a lattice ends where that of its triangles does.
TEST_F(Greedy, GroundOfPostsIsThatOfTriangles) {
  const std::vector<double> shares{1, 0.999, 0.9, 0.8};
  for (const double share : shares) {
    step_x_ = draw(20, 60), step_y_ = draw(20, 60);
    std::vector<GridPoint> points;
    for (const test::LevelPoint& p : posts(hills(), share)) points.push_back(p.point);
    test::cut_holes(points, 1.2 * step_x_, random_);
    std::vector<test::LevelPoint> with_levels;
    for (const GridPoint& p : points) with_levels.push_back({p, 0});
    test::TestIndex index(with_levels, 1, 64);
    const RegionMesh fine = surface(index, 0);
    const auto posts = LatticePosts::of(fine.vertices);
    ASSERT_TRUE(posts);
    const auto bases = [&](double columns, double rows) {
      return std::vector<std::array<double, 4>>{{columns * step_x_, 0, 0, rows * step_y_}};
    };
    const GridBox all = index->bounds();
    const GridBox some{all.xmin + 7 * step_x_, all.ymin + draw(0, 9) * step_y_, all.xmax - 11 * step_x_, all.ymax};
    for (const GridBox& box : {all, some}) {
      const auto of_posts = ground_edges(fine.vertices, *posts, GapRule(bases(1.5, 1.5)), box);
      ASSERT_TRUE(of_posts);
      const GroundEdges of_triangles = ground_edges(fine, GapRule(bases(1.5, 1.5)), box);
      ASSERT_EQ(sorted(*of_posts), sorted(of_triangles));
      ASSERT_EQ(of_posts->touched, of_triangles.touched);
    }
    // Other triangles than halves of squares are ground, too, or these are not.
    for (const auto& [columns, rows] : {std::pair{0.9, 1.5}, {1.5, 0.9}, {2.0, 1.5}, {1.5, 3.0}})
      EXPECT_FALSE(ground_edges(fine.vertices, *posts, GapRule(bases(columns, rows)), all));
  }
}

/// Neither the way in which a tile is surveyed nor where tiles end changes what is ground.
TEST_F(Greedy, TilesOfLatticesMakeTheGroundOfAll) {
  for (const double share : {1.0, 0.9}) {
    test::TestIndex index(posts(hills(), share), 1, 64);
    const RegionMesh fine = surface(index, 0);
    const std::vector<std::array<double, 4>> bases{{1.5 * step_x_, 0, 0, 1.5 * step_y_}};
    std::vector<Segment> outline, expected;
    int without_triangles = 0;
    for (const CurveRange& tile : index->tiles(300)) {
      const TileSurvey survey = survey_tile(*index, tile, bases);
      outline.insert(outline.end(), survey.outline.begin(), survey.outline.end());
      without_triangles += survey.posts.has_value() && survey.surface.mesh.triangles.empty();
    }
    EXPECT_GT(without_triangles, 4);
    for (const auto& edge : ground_edges(fine, GapRule(bases), index->bounds()).edges) expected.push_back(edge.segment);
    std::sort(outline.begin(), outline.end());
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(outline, expected);
  }
}

}  // namespace
}  // namespace itin
