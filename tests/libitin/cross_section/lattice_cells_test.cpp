// Triangles told by the cells of a lattice against those of the whole triangulation.
#include "cross_section/lattice_cells.hpp"

#include <map>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "cross_section/shared_cells.hpp"
#include "support/covered_index.hpp"
#include "support/seed.hpp"
#include "triangulate/region/region.hpp"

namespace itin {
namespace {

using test::Pattern;

using PlanPlace = std::pair<std::int32_t, std::int32_t>;
PlanPlace plan_place(const GridPoint& p) {
  return {p.x, p.y};
}

/// A triangle, whichever corner comes first.
template <class Vertex>
std::array<GridPoint, 3> turned(const std::array<Vertex, 3>& corners) {
  std::array<GridPoint, 3> t{corners[0], corners[1], corners[2]};
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// Posts with holes in their coverage, and here and there something that is no post.
std::vector<GridPoint> posts(Pattern pattern, int scale, std::mt19937& random) {
  std::vector<GridPoint> points = test::make_points(pattern, 1500, random);
  if (scale > 0)
    for (GridPoint& p : points) p.x = p.x / 50 * scale - 300, p.y = p.y / 50 * scale + 77;
  test::cut_holes(points, std::max(2, 2 * scale), random);
  const auto strays = random() % 6;
  for (unsigned i = 0; i < strays; ++i) {
    const GridPoint& p = points[random() % points.size()];
    const GridPoint stray{p.x + static_cast<int>(random() % 40), p.y + static_cast<int>(random() % 40), 5};
    const auto taken = [&](const GridPoint& q) { return plan_place(q) == plan_place(stray); };
    if (std::none_of(points.begin(), points.end(), taken)) points.push_back(stray);
  }
  return points;
}

/// The triangles of a whole store.
class WholeStore {
 public:
  WholeStore(const PointIndex& index, const Selection& selection) {
    const RegionMesh whole = triangulate_region(index, selection, index.bounds());
    for (const auto& [a, b, c] : whole.mesh.triangles) {
      const std::array<GridPoint, 3> t{whole.vertices[a].point, whole.vertices[b].point, whole.vertices[c].point};
      triangles.push_back(turned(t));
      for (std::size_t i = 0; i < 3; ++i) beyond[{plan_place(t[i]), plan_place(t[(i + 1) % 3])}] = t[(i + 2) % 3];
    }
    known.insert(triangles.begin(), triangles.end());
  }

  std::vector<std::array<GridPoint, 3>> triangles;
  std::set<std::array<GridPoint, 3>> known;
  std::map<std::pair<PlanPlace, PlanPlace>, GridPoint> beyond;
};

/// The cells that many lines share.
struct Shared {
  Shared(const PointIndex& index, const Selection& selection) : tiles(index, selection, std::uint64_t{1} << 24) {}
  SharedCells cells() { return {tiles, statistics}; }

  SectionTiles tiles;
  RetrievalStatistics statistics;
};

struct LatticeCase {
  Pattern pattern;
  int scale;     ///< grid units from post to post; 0: as the pattern has it
  bool lattice;  ///< the posts form squares, so that some triangles are told
};

/// A line of a theme from one post to another two columns and a row away: no triangle crosses it.
void add_line(WorkingIndex& index, std::vector<test::LevelPoint>& points, std::mt19937& random) {
  const auto there = [&](std::int64_t x, std::int64_t y) {
    return std::any_of(points.begin(), points.end(),
                       [&](const test::LevelPoint& p) { return p.point.x == x && p.point.y == y; });
  };
  std::vector<Segment> segments = index.all_segments();
  for (int attempt = 0; attempt < 40; ++attempt) {
    const GridPoint a = points[random() % points.size()].point, next = points[random() % points.size()].point;
    const std::int32_t s = std::abs(next.x - a.x);
    const GridBox about{a.x - s, a.y - s, a.x + 3 * s, a.y + 2 * s};
    if (s == 0 || !there(a.x + s, a.y) || !there(a.x + 2 * s, a.y + s)) continue;
    const auto near = [&](const Segment& e) { return about.meets(extent_of(e)); };
    if (std::any_of(segments.begin(), segments.end(), near)) continue;
    segments.push_back({a.x, a.y, a.x + 2 * s, a.y + s, 1});
    index.promote({{morton(a.x, a.y), 2}, {morton(a.x + 2 * s, a.y + s), 2}});
  }
  index.set_segments(segments);
}

class LatticeCellsOf : public testing::TestWithParam<LatticeCase> {
 protected:
  /// Calls visit(index, selection, whole, random) for several random stores.
  template <class Visit>
  void for_each_store(const Visit& visit) const {
    std::mt19937 random(test::seed());
    for (int run = 0; run < 6; ++run) {
      std::vector<test::LevelPoint> points;
      GridBox box;
      for (const GridPoint& p : posts(GetParam().pattern, GetParam().scale, random)) {
        points.push_back({p, static_cast<int>(random() % 3)});
        box.extend(p.x, p.y);
      }
      const double area = 1.0 * (box.xmax - box.xmin) * (box.ymax - box.ymin);
      test::TestIndex index(points, 3, 1 + random() % 60);
      test::survey_outline(index, 3, std::max(2.0, 2.5 * std::sqrt(area / static_cast<double>(points.size()))));
      add_line(*index, points, random);
      const Selection selection(Detail::tolerance(run < 4 ? 0 : 1), {0, 1, 2}, {{0, 0}, 1.0});
      visit(*index, selection, WholeStore(*index, selection), random);
    }
  }
};

TEST_P(LatticeCellsOf, TellTheTriangleBeyondAnEdgeOrNothing) {
  std::size_t told = 0, told_to_many = 0, asked = 0;
  for_each_store([&](const PointIndex& index, const Selection& selection, const WholeStore& whole,
                     std::mt19937& random) {
    const ReadOnce blocks(index);
    std::optional<LatticeCells> cells;
    Shared shared(index, selection);
    SharedCells of_many = shared.cells();
    for (const auto& [a, b, c] : whole.triangles) {
      // As for lines: many edges near each other, then others.
      if (!cells || random() % 50 == 0) {
        const double angle = static_cast<double>(random());
        cells.emplace(blocks, selection, Point2{std::cos(angle), std::sin(angle)});
      }
      for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, a}, {b, a}, {c, b}, {a, c}}) {
        const auto expected = whole.beyond.find({plan_place(p), plan_place(q)});
        ++asked;
        for (CellTriangles* triangles : {static_cast<CellTriangles*>(&*cells), static_cast<CellTriangles*>(&of_many)}) {
          const auto found = triangles->beyond({p.x, p.y}, {q.x, q.y});
          if (!found) continue;
          ASSERT_NE(expected, whole.beyond.end())
              << "no ground lies beyond " << p.x << " " << p.y << ", " << q.x << " " << q.y;
          ASSERT_EQ(static_cast<const GridPoint&>(*found), expected->second);
          ++(triangles == &of_many ? told_to_many : told);
        }
      }
    }
  });
  EXPECT_TRUE((told > 0 && told_to_many > 0) || !GetParam().lattice)
      << asked << " asked, " << told << " told to one line, " << told_to_many << " to many";
}

TEST_P(LatticeCellsOf, AreAllThatMeetsABoxOrNone) {
  std::size_t told = 0, told_to_many = 0, asked = 0;
  for_each_store([&](const PointIndex& index, const Selection& selection, const WholeStore& whole,
                     std::mt19937& random) {
    const GridBox all = index.bounds();
    Shared shared(index, selection);
    for (int i = 0; i < 200; ++i) {
      const auto within = [&](std::int32_t low, std::int32_t high) {
        return low + static_cast<std::int32_t>(random() % static_cast<unsigned>(high - low));
      };
      GridPoint low{within(all.xmin, all.xmax), within(all.ymin, all.ymax), 0};
      if (i % 4 == 0) low = whole.triangles[random() % whole.triangles.size()][0];
      const GridBox box{low.x, low.y, low.x + static_cast<int>(random() % 2), low.y + static_cast<int>(random() % 2)};
      ++asked;
      const ReadOnce blocks(index);
      LatticeCells of_one(blocks, selection, {0, 1});
      SharedCells of_many = shared.cells();
      for (CellTriangles* triangles : {static_cast<CellTriangles*>(&of_one), static_cast<CellTriangles*>(&of_many)}) {
        std::set<std::array<GridPoint, 3>> found;
        for (const auto& t : triangles->around(box)) found.insert(turned(t));
        if (found.empty()) continue;
        ++(triangles == &of_many ? told_to_many : told);
        for (const auto& t : found) ASSERT_TRUE(whole.known.contains(t)) << "box at " << box.xmin << " " << box.ymin;
        const RegionMesh expected = triangulate_region(index, selection, box);
        for (const auto& [a, b, c] : expected.mesh.triangles) {
          const std::array corners{expected.vertices[a].point, expected.vertices[b].point, expected.vertices[c].point};
          ASSERT_TRUE(found.contains(turned(corners)));
        }
      }
    }
  });
  EXPECT_TRUE((told > 0 && told_to_many > 0) || !GetParam().lattice)
      << asked << " asked, " << told << " told to one line, " << told_to_many << " to many";
}

INSTANTIATE_TEST_SUITE_P(
    CrossSection, LatticeCellsOf,
    testing::Values(LatticeCase{Pattern::kLattice, 50, true}, LatticeCase{Pattern::kLattice, 7, true},
                    LatticeCase{Pattern::kLattice, 1, true}, LatticeCase{Pattern::kGappyLattice, 0, false},
                    LatticeCase{Pattern::kTurnedLattice, 0, false}, LatticeCase{Pattern::kRandom, 0, false}));

}  // namespace
}  // namespace itin
