// Simplified lines never cross, whatever levels meet; checked for all pairs.
#include "features/contours/line_hierarchy.hpp"

#include <iostream>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "features/plan/hot_pixel.hpp"
#include "features/plan/planar.hpp"
#include "support/seed.hpp"
#include "triangulate/apex/apex.hpp"

namespace itin {
namespace {

constexpr int kCoarsest = 5;

struct Lines {
  PlanarLines planar;
  std::vector<Segment> segments, whole;
  std::map<Position, std::int32_t> heights;
  std::vector<LineTolerance> tolerances{{0, 0}, {8, 8}, {16, 16}, {32, 32}, {64, 64}, {128, 128}};

  LineHierarchy hierarchy(const std::vector<std::uint64_t>& nodes = {}) const {
    return LineHierarchy(
        segments, whole, nodes, [&](Position p) { return heights.at(p); }, tolerances);
  }
};

/// Wandering lines and rings of three themes, made planar; theme 3 is not generalised.
Lines wandering(std::mt19937& random, int lines, int length) {
  const auto in = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  std::vector<OwnedSegment> pieces;
  for (int i = 0; i < lines; ++i) {
    GridPoint p{in(0, 1500), in(0, 1500), in(0, 100)};
    const GridPoint start = p;
    double heading = in(0, 628) / 100.0;
    const auto owner = static_cast<std::uint32_t>(in(0, 2));
    for (int k = 0; k < length; ++k) {
      heading += in(-80, 80) / 100.0;
      const int step = in(5, 40);
      const GridPoint q{p.x + static_cast<int>(step * std::cos(heading)),
                        p.y + static_cast<int>(step * std::sin(heading)), p.z + in(-5, 5)};
      pieces.push_back({p, q, owner});
      p = q;
    }
    if (i % 3 == 0) pieces.push_back({p, start, owner});
  }
  Lines result;
  result.planar = make_planar(pieces);
  for (const GridPoint& p : result.planar.vertices) result.heights[{p.x, p.y}] = p.z;
  for (const PlanarEdge& e : result.planar.edges) {
    const GridPoint &a = result.planar.vertices[e.from], &b = result.planar.vertices[e.to];
    const Segment s{a.x, a.y, b.x, b.y, static_cast<std::uint16_t>(e.owner + 1)};
    (e.owner == 2 ? result.whole : result.segments).push_back(s);
  }
  return result;
}

GridBox extent(const Segment& s) {
  return {std::min(s.ax, s.bx) - s.reach, std::min(s.ay, s.by) - s.reach, std::max(s.ax, s.bx) + s.reach,
          std::max(s.ay, s.by) + s.reach};
}

/// Whether no tolerance that varies can select both: what one stands for includes the other, at other levels.
bool exclusive(const Segment& fine, const Segment& coarse) {
  return fine.coarsest < coarse.finest && extent(coarse).contains(extent(fine));
}

void expect_no_crossing(const std::vector<Segment>& segments) {
  for (const Segment& s : segments) {
    for (const Segment& t : segments) {
      const Position a{s.ax, s.ay}, b{s.bx, s.by}, c{t.ax, t.ay}, d{t.bx, t.by};
      if (exclusive(s, t) || exclusive(t, s)) continue;
      ASSERT_FALSE(crosses(s, c, d)) << a.x << " " << a.y << " " << b.x << " " << b.y << " x " << c.x << " " << c.y
                                     << " " << d.x << " " << d.y;
      for (const Position end : {c, d}) ASSERT_TRUE(end == a || end == b || !on_segment(a, b, end));
    }
  }
}

/// At every level each vertex of that level is an end, and lines still join what they joined.
void expect_whole_lines(const Lines& lines, const LineHierarchy& hierarchy) {
  const std::vector<Segment> segments = hierarchy.segments();
  std::map<std::uint64_t, int> level;
  for (const auto& [code, l] : hierarchy.levels()) level[code] = std::max(level[code], int{l});
  for (int k = 0; k <= kCoarsest; ++k) {
    std::set<std::uint64_t> ends;
    std::size_t count = 0;
    for (const Segment& s : segments) {
      if (s.finest > k || k > s.coarsest) continue;
      ++count;
      for (const std::uint64_t end : {morton(s.ax, s.ay), morton(s.bx, s.by)}) {
        ASSERT_GE(level.at(end), k);
        ends.insert(end);
      }
    }
    ASSERT_TRUE(k > 0 || count == lines.segments.size());
    for (const auto& [code, l] : level) ASSERT_EQ(ends.contains(code), l >= k);
  }
}

TEST(LineHierarchy, NothingCrossesAtAnyMixtureOfLevels) {
  std::mt19937 random(test::seed());
  std::size_t fine = 0, coarse = 0;
  for (int run = 0; run < 40; ++run) {
    const Lines lines = wandering(random, 1 + static_cast<int>(random() % 12), 40);
    LineHierarchy hierarchy = lines.hierarchy();
    std::vector<Segment> all = hierarchy.segments();
    for (const Segment& s : all) {
      fine += s.finest == 0;
      coarse += s.coarsest == 0xff;
    }
    expect_whole_lines(lines, hierarchy);
    all.insert(all.end(), lines.whole.begin(), lines.whole.end());
    expect_no_crossing(all);
    if (HasFatalFailure()) FAIL() << "run " << run;
    // Putting detail back somewhere leaves all of this true.
    std::vector<LineHierarchy::Shortcut> shortcuts;
    for (const Segment& s : hierarchy.segments()) {
      if (s.finest > 0 && random() % 3 == 0) shortcuts.push_back({s.finest, {s.ax, s.ay}, {s.bx, s.by}});
    }
    std::sort(shortcuts.begin(), shortcuts.end());
    hierarchy.restore(shortcuts);
    expect_whole_lines(lines, hierarchy);
    all = hierarchy.segments();
    all.insert(all.end(), lines.whole.begin(), lines.whole.end());
    expect_no_crossing(all);
    if (HasFatalFailure()) FAIL() << "run " << run << ", restored";
  }
  EXPECT_LT(2 * coarse, fine) << "hardly anything was simplified";
}

TEST(LineHierarchy, AStraightLineKeepsItsEndsOnly) {
  Lines lines;
  for (int i = 0; i < 10; ++i) lines.segments.push_back({10 * i, 20 * i, 10 * i + 10, 20 * i + 20, 1});
  for (int i = 0; i <= 10; ++i) lines.heights[{10 * i, 20 * i}] = 7 * i;
  const LineHierarchy hierarchy = lines.hierarchy();
  const std::vector<Segment> segments = hierarchy.segments();
  ASSERT_EQ(segments.size(), 11u);
  EXPECT_EQ(segments[1], (Segment{0, 0, 100, 200, 1, 1, 0xff, 0}));
  EXPECT_EQ(hierarchy.levels().size(), 11u);
}

TEST(LineHierarchy, HeightsCountLikePositions) {
  Lines lines;
  for (int i = 0; i < 2; ++i) lines.segments.push_back({10 * i, 0, 10 * i + 10, 0, 1});
  lines.heights = {{{0, 0}, 0}, {{10, 0}, 50}, {{20, 0}, 0}};
  // 50 units off: within 64, not within 32.
  for (const auto& [code, level] : lines.hierarchy().levels()) EXPECT_EQ(level, code == morton(10, 0) ? 3 : kCoarsest);
}

TEST(LineHierarchy, AVertexInTheWayKeepsTheLine) {
  // A small dent with something in it.
  Lines lines;
  lines.segments = {{0, 0, 10, 5, 1}, {10, 5, 20, 0, 1}};
  lines.heights = {{{0, 0}, 0}, {{10, 5}, 0}, {{20, 0}, 0}};
  EXPECT_EQ(lines.hierarchy().segments().size(), 3u);
  EXPECT_EQ(lines.hierarchy({morton(10, 3)}).segments().size(), 2u);
  EXPECT_EQ(lines.hierarchy({morton(10, 0)}).segments().size(), 2u);
  EXPECT_EQ(lines.hierarchy({morton(10, -1)}).segments().size(), 3u);
}

}  // namespace
}  // namespace itin
