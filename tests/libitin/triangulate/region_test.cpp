// Law 1: the window equals the whole.
#include "triangulate/region/region.hpp"

#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include <itin/detail.hpp>
#include <itin/window.hpp>

#include "features/plan/planar.hpp"
#include "pyramid/coverage/coverage.hpp"
#include "support/points.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

using test::LevelPoint;
using test::Pattern;

constexpr int kLevels = 4;

using IndexCorners = std::array<std::int32_t, 3>;
using TriangleKey = std::array<IndexCorners, 3>;

TriangleKey key(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  TriangleKey k{{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}}};
  std::rotate(k.begin(), std::min_element(k.begin(), k.end()), k.end());
  return k;
}

std::set<TriangleKey> keys(const RegionMesh& region) {
  std::set<TriangleKey> result;
  for (const auto& [a, b, c] : region.mesh.triangles) {
    result.insert(key(region.vertices[a].point, region.vertices[b].point, region.vertices[c].point));
  }
  EXPECT_EQ(result.size(), region.mesh.triangles.size()) << "a triangle twice";
  return result;
}

/// The triangulation of everything at once, as CGAL gives it, ground or not.
struct Whole {
  std::vector<GridPoint> points;
  PlaneMesh mesh;
};

Whole whole(const std::vector<GridPoint>& points, const std::vector<Segment>& segments) {
  Whole result{points, {}};
  std::vector<Position> positions;
  std::map<std::pair<int, int>, std::uint32_t> number;
  for (const GridPoint& p : points) {
    number[{p.x, p.y}] = static_cast<std::uint32_t>(positions.size());
    positions.push_back({p.x, p.y});
  }
  // Shuffled, so that nothing rests on the order of insertion.
  Delaunay delaunay;
  delaunay.insert(positions);
  std::vector<Delaunay::Constraint> constraints;
  for (const Segment& s : segments) constraints.emplace_back(number.at({s.ax, s.ay}), number.at({s.bx, s.by}));
  delaunay.constrain(constraints);
  result.mesh = delaunay.mesh();
  return result;
}

/// Empty when both sets are equal, else what differs, as text.
std::string differences(const std::set<TriangleKey>& found, const std::set<TriangleKey>& expected) {
  std::ostringstream text;
  const auto list = [&](const char* title, const std::set<TriangleKey>& a, const std::set<TriangleKey>& b) {
    for (const TriangleKey& t : a) {
      if (b.contains(t)) continue;
      text << title;
      for (const IndexCorners& c : t) text << " (" << c[0] << ", " << c[1] << ")";
      text << "\n";
    }
  };
  list("wrong:  ", found, expected);
  list("missing:", expected, found);
  return text.str();
}

Selection all_levels() {
  return Selection(Detail::tolerance(0), {0.0}, Grid{{0, 0}, 1.0});
}

std::set<TriangleKey> meeting(const Whole& whole, const GridWindow& window) {
  std::set<TriangleKey> result;
  for (const auto& [a, b, c] : whole.mesh.triangles) {
    if (window.meets(whole.points[a], whole.points[b], whole.points[c])) {
      result.insert(key(whole.points[a], whole.points[b], whole.points[c]));
    }
  }
  return result;
}

GridBox box_of(const std::vector<GridPoint>& points) {
  GridBox box;
  for (const GridPoint& p : points) box.extend(p.x, p.y);
  return box;
}

std::vector<Window> windows_about(const GridBox& b, std::mt19937& random) {
  const auto in = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 10001) / 10000.0;
  };
  const double width = std::max(1, b.xmax - b.xmin), height = std::max(1, b.ymax - b.ymin);
  const auto point = [&] {
    return Point2{in(b.xmin - 0.1 * width, b.xmax + 0.1 * width), in(b.ymin - 0.1 * height, b.ymax + 0.1 * height)};
  };
  std::vector<Window> result{Window::all()};
  for (int i = 0; i < 4; ++i) {
    const Point2 p = point(), q = point(), r = point();
    result.push_back(
        Window::box({std::min(p.x, q.x), std::min(p.y, q.y), std::max(p.x, q.x) + 1, std::max(p.y, q.y) + 1}));
    result.push_back(Window::disc(p, in(1, width / 2)));
    result.push_back(Window::wedge(q, in(0, 360), in(1, 360), in(2, width)));
    if (p.x != q.x) result.push_back(Window::corridor(p, q, in(2, width / 10)));
    const double s = in(10, width / 2 + 20);
    result.push_back(Window::polygons({{{{r.x - s, r.y - s}, {r.x + s, r.y - s}, {r.x, r.y + s}},
                                        {{{r.x, r.y - s / 2}, {r.x + s / 8, r.y - s / 2}, {r.x, r.y}}}}}));
  }
  return result;
}

class RegionPatterns : public testing::TestWithParam<Pattern> {};

TEST_P(RegionPatterns, WindowEqualsWhole) {
  const auto seed = test::seed();
  std::mt19937 random(seed + static_cast<unsigned>(GetParam()));
  for (int run = 0; run < 12; ++run) {
    const std::vector<GridPoint> points = test::make_points(GetParam(), 3 + static_cast<int>(random() % 1500), random);
    std::vector<LevelPoint> with_levels;
    for (const GridPoint& p : points) with_levels.push_back({p, 0});
    test::TestIndex index(with_levels, 1, 1 + random() % 40);
    const Whole truth = whole(points, {});
    const Selection selection = all_levels();
    for (const Window& window : windows_about(box_of(points), random)) {
      const GridWindow grid_window(window, Grid{{0, 0}, 1.0}, index->bounds());
      const RegionMesh region = triangulate_region(*index, selection, grid_window.bounds(), &grid_window);
      ASSERT_EQ(differences(keys(region), meeting(truth, grid_window)), "")
          << "run " << run << ", " << points.size() << " points, window "
          << testing::PrintToString(grid_window.bounds().xmin) << " " << grid_window.bounds().ymin << " "
          << grid_window.bounds().xmax << " " << grid_window.bounds().ymax;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Region, RegionPatterns,
                         testing::Values(Pattern::kRandom, Pattern::kLattice, Pattern::kClusters, Pattern::kContours,
                                         Pattern::kCollinear, Pattern::kCocircular, Pattern::kGappyLattice,
                                         Pattern::kTurnedLattice));

/// Whether three times the centroid of abc lies in a triangle of `ground`, scaled likewise.
bool centroid_in(const std::vector<std::array<GridPoint, 3>>& ground, const GridPoint& a, const GridPoint& b,
                 const GridPoint& c) {
  const Position p{a.x + b.x + c.x, a.y + b.y + c.y};
  return std::any_of(ground.begin(), ground.end(), [&](const auto& t) {
    const Position q{3 * t[0].x, 3 * t[0].y}, r{3 * t[1].x, 3 * t[1].y}, s{3 * t[2].x, 3 * t[2].y};
    return orientation(q, r, p) >= 0 && orientation(r, s, p) >= 0 && orientation(s, q, p) >= 0;
  });
}

/// The outline of the union of some triangles of a triangulation, joined where it runs straight.
std::vector<Segment> outline_of(const Whole& whole, const std::vector<std::array<GridPoint, 3>>& ground) {
  std::set<Segment> edges;
  for (const auto& t : ground) {
    for (std::size_t i = 0; i < 3; ++i) edges.insert({t[i].x, t[i].y, t[(i + 1) % 3].x, t[(i + 1) % 3].y});
  }
  std::vector<Segment> outline;
  for (const Segment& s : edges) {
    if (!edges.contains({s.bx, s.by, s.ax, s.ay})) outline.push_back(s);
  }
  EXPECT_FALSE(whole.mesh.triangles.empty());
  return join_collinear(outline);
}

class RegionCoverage : public testing::TestWithParam<Pattern> {};

void expect_windows_equal_the_whole_across_voids(Pattern pattern, unsigned seed) {
  std::mt19937 random(seed + static_cast<unsigned>(pattern));
  for (int run = 0; run < 8; ++run) {
    std::vector<GridPoint> points = test::make_points(pattern, 200 + static_cast<int>(random() % 1000), random);
    const GridBox box = box_of(points);
    const double gap =
        2.0 * std::sqrt(1.0 * (box.xmax - box.xmin) * (box.ymax - box.ymin) / static_cast<double>(points.size()));
    for (int i = 0; i < 3; ++i) {
      const std::int64_t x = box.xmin + static_cast<int>(random() % static_cast<unsigned>(box.xmax - box.xmin));
      const std::int64_t y = box.ymin + static_cast<int>(random() % static_cast<unsigned>(box.ymax - box.ymin));
      std::erase_if(points,
                    [&](const GridPoint& p) { return (p.x - x) * (p.x - x) + (p.y - y) * (p.y - y) < 6 * gap * gap; });
    }
    if (whole(points, {}).mesh.triangles.empty()) continue;  // the voids took it all
    std::vector<LevelPoint> with_levels;
    for (const GridPoint& p : points) {
      const unsigned dice = static_cast<unsigned>(random() % 16);
      with_levels.push_back({p, dice < 9 ? 0 : dice < 13 ? 1 : dice < 15 ? 2 : 3});
    }
    test::TestIndex index(with_levels, kLevels, 1 + random() % 40);
    std::vector<Segment> edges;
    std::set<std::uint64_t> corners;
    for (const CurveRange& tile : index->tiles(1 + random() % 300)) {
      const TileSurvey survey = survey_tile(*index, tile, {{gap, 0, 0, gap}});
      edges.insert(edges.end(), survey.outline.begin(), survey.outline.end());
      for (std::size_t v = 0; v < survey.candidacy.size(); ++v) {
        const GridPoint& p = survey.surface.vertices[v].point;
        if (survey.candidacy[v] == Candidacy::kCorner && tile.cell.contains(morton(p.x, p.y)))
          corners.insert(morton(p.x, p.y));
      }
    }
    const std::vector<Segment> outline = join_collinear(edges);
    index->set_segments(outline);
    std::set<std::uint64_t> ends;
    for (const Segment& s : outline) {
      for (const std::uint64_t end : {morton(s.ax, s.ay), morton(s.bx, s.by)}) {
        ends.insert(end);
        index->promote({{end, kLevels - 1}});
      }
    }
    ASSERT_EQ(corners, ends);

    std::vector<std::array<GridPoint, 3>> ground;
    const Whole finest = whole(points, {});
    for (const auto& [a, b, c] : finest.mesh.triangles) {
      const std::array t{points[a], points[b], points[c]};
      const auto short_enough = [&](const GridPoint& p, const GridPoint& q) {
        return std::abs(p.x - q.x) <= gap && std::abs(p.y - q.y) <= gap;
      };
      if (short_enough(t[0], t[1]) && short_enough(t[1], t[2]) && short_enough(t[2], t[0])) ground.push_back(t);
    }

    ASSERT_EQ(outline, outline_of(finest, ground)) << "run " << run << ", " << points.size() << " points, gap " << gap;

    for (const Segment& s : outline) {
      for (const Segment& t : outline) {
        ASSERT_FALSE(crosses(s, {t.ax, t.ay}, {t.bx, t.by}))
            << s.ax << " " << s.ay << " " << s.bx << " " << s.by << " x " << t.ax << " " << t.ay << " " << t.bx << " "
            << t.by;
      }
    }
    for (int k = 0; k < kLevels; ++k) {
      std::vector<GridPoint> selected;
      for (const CurveRange& tile : index->tiles(1 << 30)) {
        for (const RawPoint& p : index->read(tile)) {
          if (p.level >= k) selected.push_back({morton_x(p.code), morton_y(p.code), p.z});
        }
      }
      Whole truth = whole(selected, outline);
      std::erase_if(truth.mesh.triangles, [&](const auto& t) {
        return !centroid_in(ground, selected[t[0]], selected[t[1]], selected[t[2]]);
      });
      const std::vector<double> tolerances{0, 1, 2, 3};
      const Selection selection(Detail::tolerance(k), tolerances, Grid{{0, 0}, 1.0});
      for (const Window& window : windows_about(box, random)) {
        const GridWindow grid_window(window, Grid{{0, 0}, 1.0}, index->bounds());
        const RegionMesh region = triangulate_region(*index, selection, grid_window.bounds(), &grid_window);
        ASSERT_EQ(differences(keys(region), meeting(truth, grid_window)), "")
            << "run " << run << ", level " << k << ", " << points.size() << " points, gap " << gap << ", window "
            << grid_window.bounds().xmin << " " << grid_window.bounds().ymin << " " << grid_window.bounds().xmax << " "
            << grid_window.bounds().ymax;
      }
    }
  }
}

TEST_P(RegionCoverage, WindowEqualsWholeAtEveryLevelAcrossVoids) {
  expect_windows_equal_the_whole_across_voids(GetParam(), test::seed());
}

// A small window within one large triangle, behind an outline that is all that was read at first.
TEST_P(RegionCoverage, WindowBehindAnOutlineEqualsTheWhole) {
  expect_windows_equal_the_whole_across_voids(GetParam(), 102);
}

INSTANTIATE_TEST_SUITE_P(Region, RegionCoverage,
                         testing::Values(Pattern::kRandom, Pattern::kLattice, Pattern::kClusters, Pattern::kContours,
                                         Pattern::kGappyLattice, Pattern::kTurnedLattice));

constexpr std::int32_t kCoastSide = 1000000;

/// Land, and water at its upper right corner whose points are of level 0 but for the corner itself.
std::vector<LevelPoint> coast(std::mt19937& random) {
  std::vector<LevelPoint> points;
  const auto add = [&](std::int32_t x, std::int32_t y) {
    const bool corner = x % kCoastSide == 0 && y % kCoastSide == 0;
    const bool water = std::hypot(x - kCoastSide, y - kCoastSide) < 0.4 * kCoastSide;
    points.push_back({{x, y, 0}, water && !corner ? 0 : kLevels - 1});
  };
  for (const std::int32_t x : {0, kCoastSide})
    for (const std::int32_t y : {0, kCoastSide}) add(x, y);
  for (int i = 0; i < 100000; ++i)
    add(1 + static_cast<std::int32_t>(random() % (kCoastSide - 1)),
        1 + static_cast<std::int32_t>(random() % (kCoastSide - 1)));
  return points;
}

// All that the water's surroundings show at first is the outline, whose triangles hold all of the land. What lies far
// behind the shore is no concern of the triangles across the water.
TEST(RegionOnWater, IsMadeFromTheShoreAlone) {
  std::mt19937 random(test::seed());
  test::TestIndex index(coast(random), kLevels, 32);
  index->set_segments({{0, 0, kCoastSide, 0},
                       {kCoastSide, 0, kCoastSide, kCoastSide},
                       {kCoastSide, kCoastSide, 0, kCoastSide},
                       {0, kCoastSide, 0, 0}});
  const Selection selection(Detail::tolerance(1), std::vector<double>{0, 1, 2, 3}, Grid{{0, 0}, 1.0});
  std::uint64_t blocks = 0;
  for (int run = 0; run < 20; ++run) {
    const auto x = static_cast<std::int32_t>(850000 + random() % 100000),
               y = static_cast<std::int32_t>(850000 + random() % 100000);
    blocks += triangulate_region(*index, selection, {x, y, x + 30000, y + 30000}).statistics.blocks_read;
  }
  EXPECT_LT(blocks, 20 * 200) << "seed " << test::seed();
}

class RegionLines : public testing::TestWithParam<Pattern> {};

/// Segments between random positions, of which many are points: through others, along each other, crossing.
std::vector<OwnedSegment> random_segments(const std::vector<GridPoint>& points, int count, std::mt19937& random) {
  const GridBox box = box_of(points);
  const auto end = [&] {
    if (random() % 2 == 0) return points[random() % points.size()];
    const auto in = [&](std::int32_t low, std::int32_t high) {
      return low + static_cast<std::int32_t>(random() % static_cast<unsigned>(high - low + 1));
    };
    return GridPoint{in(box.xmin, box.xmax), in(box.ymin, box.ymax), in(0, 2000)};
  };
  std::vector<OwnedSegment> segments;
  for (int i = 0; i < count; ++i) segments.push_back({end(), end(), static_cast<std::uint32_t>(random() % 2)});
  return segments;
}

/// Long lines of short pieces that are almost straight, as streets are digitised, with points hard beside them: thin
/// triangles with enormous circumdiscs, of which they see next to nothing.
std::vector<OwnedSegment> streets(std::vector<GridPoint>& points, int count, std::mt19937& random) {
  const GridBox box = box_of(points);
  const auto in = [&](std::int32_t low, std::int32_t high) {
    return low + static_cast<std::int32_t>(random() % static_cast<unsigned>(high - low + 1));
  };
  std::vector<OwnedSegment> segments;
  for (int i = 0; i < count; ++i) {
    const GridPoint from{in(box.xmin, box.xmax), in(box.ymin, box.ymax), 0};
    const GridPoint to{in(box.xmin, box.xmax), in(box.ymin, box.ymax), 0};
    constexpr int kPieces = 12;
    GridPoint last = from;
    for (int k = 1; k <= kPieces; ++k) {
      const auto at = [&](std::int32_t a, std::int32_t b) {
        return static_cast<std::int32_t>(a + (std::int64_t{b} - a) * k / kPieces) + in(-1, 1);
      };
      const GridPoint next{at(from.x, to.x), at(from.y, to.y), in(0, 2000)};
      segments.push_back({last, next, static_cast<std::uint32_t>(i % 2)});
      points.push_back({(last.x + next.x) / 2 + in(-2, 2), (last.y + next.y) / 2 + in(-2, 2), in(0, 2000)});
      last = next;
    }
  }
  return segments;
}

/// At every level, with and without the second theme, in random windows.
void expect_windows_equal_whole(const std::vector<GridPoint>& points, const std::vector<OwnedSegment>& crossing,
                                std::mt19937& random) {
  std::map<Position, LevelPoint> by_position;
  for (const GridPoint& p : points) by_position[{p.x, p.y}] = {p, static_cast<int>(random() % kLevels)};
  const PlanarLines lines = make_planar(crossing);
  for (const GridPoint& p : lines.vertices) by_position[{p.x, p.y}] = {p, kLevels - 1};
  std::vector<LevelPoint> all;
  for (const auto& [position, point] : by_position) all.push_back(point);
  std::vector<Segment> segments;
  for (const PlanarEdge& e : lines.edges) {
    const GridPoint &a = lines.vertices[e.from], &b = lines.vertices[e.to];
    segments.push_back({a.x, a.y, b.x, b.y, static_cast<std::uint16_t>(e.owner + 1)});
  }
  test::TestIndex index(all, kLevels, 1 + random() % 40);
  index->set_segments(segments);

  for (int k = 0; k < kLevels; ++k) {
    for (const bool both : {true, false}) {
      std::vector<GridPoint> selected;
      for (const LevelPoint& p : all) {
        if (p.level >= k) selected.push_back(p.point);
      }
      std::vector<Segment> chosen = segments;
      Selection selection(Detail::tolerance(k), {0, 1, 2, 3}, Grid{{0, 0}, 1.0});
      if (!both) {
        selection.leave_out(2);
        std::erase_if(chosen, [](const Segment& s) { return s.theme == 2; });
      }
      const Whole truth = whole(selected, chosen);
      for (const Window& window : windows_about(box_of(points), random)) {
        const GridWindow grid_window(window, Grid{{0, 0}, 1.0}, index->bounds());
        const RegionMesh region = triangulate_region(*index, selection, grid_window.bounds(), &grid_window);
        ASSERT_EQ(differences(keys(region), meeting(truth, grid_window)), "")
            << "level " << k << ", " << points.size() << " points, " << chosen.size() << " segments, window "
            << grid_window.bounds().xmin << " " << grid_window.bounds().ymin << " " << grid_window.bounds().xmax << " "
            << grid_window.bounds().ymax;
      }
    }
  }
}

void expect_windows_equal_whole_among_lines(Pattern pattern, unsigned seed) {
  std::mt19937 random(seed + static_cast<unsigned>(pattern));
  for (int run = 0; run < 3; ++run) {
    const std::vector<GridPoint> points = test::make_points(pattern, 20 + static_cast<int>(random() % 1000), random);
    expect_windows_equal_whole(points, random_segments(points, 1 + static_cast<int>(random() % 40), random), random);
  }
}

TEST_P(RegionLines, WindowEqualsWholeAtEveryLevelWithAndWithoutATheme) {
  expect_windows_equal_whole_among_lines(GetParam(), test::seed());
}

/// Far ends of lines were the hull of what a window had read, and lines hid from them all that lies beyond.
TEST(RegionLinesOnce, AWindowBeyondTheHullOfFarEndsIsNotEmpty) {
  expect_windows_equal_whole_among_lines(Pattern{2}, 39023);
}

TEST_P(RegionLines, WindowEqualsWholeAlongStreets) {
  const auto seed = test::seed();
  std::mt19937 random(seed + 100 + static_cast<unsigned>(GetParam()));
  for (int run = 0; run < 2; ++run) {
    std::vector<GridPoint> points = test::make_points(GetParam(), 300 + static_cast<int>(random() % 2500), random);
    const std::vector<OwnedSegment> lines = streets(points, 1 + static_cast<int>(random() % 12), random);
    expect_windows_equal_whole(points, lines, random);
  }
}

INSTANTIATE_TEST_SUITE_P(Region, RegionLines,
                         testing::Values(Pattern::kRandom, Pattern::kLattice, Pattern::kClusters, Pattern::kContours,
                                         Pattern::kCollinear, Pattern::kCocircular, Pattern::kGappyLattice,
                                         Pattern::kTurnedLattice));

}  // namespace
}  // namespace itin
