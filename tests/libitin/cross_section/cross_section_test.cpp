// Cross-sections against every triangle of the whole cut by the line.
#include <iostream>
#include <sstream>
#include <type_traits>

#include <gtest/gtest.h>

#include <itin/cross_section.hpp>

#include "cross_section/retrieval.hpp"
#include "cross_section/tiled_section.hpp"
#include "support/covered_index.hpp"
#include "support/section_text.hpp"
#include "support/seed.hpp"
#include "support/slow_section.hpp"
#include "triangulate/region/region.hpp"

namespace itin {
namespace {

using test::mirrored;
using test::Pattern;
using test::text;

/// Ends of every kind: anywhere, at vertices, in the middle of two vertices, due north and east of another.
class Ends {
 public:
  Ends(const std::vector<GridPoint>& points, std::mt19937& random) : points_(points), random_(random) {
    for (const GridPoint& p : points) box_.extend(p.x, p.y);
  }

  Point2 any() {
    switch (random_() % 4) {
      case 0:
        return vertex();
      case 1: {
        const Point2 p = vertex(), q = vertex();
        return {(p.x + q.x) / 2, (p.y + q.y) / 2};
      }
      default:
        return {between(box_.xmin, box_.xmax), between(box_.ymin, box_.ymax)};
    }
  }

  std::pair<Point2, Point2> line() {
    const Point2 a = any();
    Point2 b = any();
    switch (random_() % 8) {
      case 0:
        b.x = a.x;
        break;
      case 1:
        b.y = a.y;
        break;
      case 2:
        b = {a.x + (b.y - a.y), b.y};
        break;
      case 3:
        b = a;
        break;
      case 4:
        b = {a.x + (b.x - a.x) / 50, a.y + (b.y - a.y) / 50};
        break;
      default:
        break;
    }
    return {a, b};
  }

 private:
  Point2 vertex() {
    const GridPoint& p = points_[random_() % points_.size()];
    return {static_cast<double>(p.x), static_cast<double>(p.y)};
  }
  double between(double low, double high) {
    const double margin = 0.1 * (high - low) + 1;
    return low - margin + (high - low + 2 * margin) * static_cast<double>(random_()) / 4294967296.0;
  }

  const std::vector<GridPoint>& points_;
  std::mt19937& random_;
  GridBox box_;
};

class SectionPatterns : public testing::TestWithParam<Pattern> {};

TEST_P(SectionPatterns, EqualEveryTriangleCutByTheLine) {
  const auto seed = test::seed();
  std::mt19937 random(seed + static_cast<unsigned>(GetParam()));
  constexpr int kLevels = 4;
  const std::vector<double> tolerances{0, 1, 2, 3};
  const Grid grid{{0, 0}, 1.0};
  std::size_t with_gaps = 0, pieces = 0;
  for (int run = 0; run < 8; ++run) {
    std::vector<GridPoint> points = test::make_points(GetParam(), 200 + static_cast<int>(random() % 1200), random);
    GridBox box;
    for (const GridPoint& p : points) box.extend(p.x, p.y);
    const double gap =
        2.0 * std::sqrt(1.0 * (box.xmax - box.xmin) * (box.ymax - box.ymin) / static_cast<double>(points.size()));
    test::cut_holes(points, gap, random);
    if (points.size() < 3) continue;
    std::vector<test::LevelPoint> with_levels;
    for (const GridPoint& p : points) {
      const unsigned dice = static_cast<unsigned>(random() % 16);
      with_levels.push_back({p, dice < 9 ? 0 : dice < 13 ? 1 : dice < 15 ? 2 : 3});
    }
    test::TestIndex index(with_levels, kLevels, 1 + random() % 40);
    test::survey_outline(index, kLevels, gap);
    const Point2 centre{static_cast<double>(points.front().x), static_cast<double>(points.front().y)};
    for (const Detail& detail : {Detail::tolerance(0), Detail::tolerance(2),
                                 Detail::rings(centre, {{gap * 3, 0}, {gap * 9, 1}, {gap * 20, 3}})}) {
      const Selection selection(detail, tolerances, grid);
      const RegionMesh whole = triangulate_region(*index, selection, index->bounds());
      std::vector<std::array<GridPoint, 3>> triangles;
      for (const auto& [a, b, c] : whole.mesh.triangles) {
        triangles.push_back({whole.vertices[a].point, whole.vertices[b].point, whole.vertices[c].point});
      }
      SectionTiles tiles(*index, selection, std::uint64_t{1} << 24);
      Ends ends(points, random);
      for (int i = 0; i < 120; ++i) {
        const auto [a, b] = ends.line();
        const SectionLine line(grid, a, b);
        CrossSection expected = test::slow_section(line, triangles);
        if (line.is_mirrored()) expected = mirrored(expected);
        const CrossSection found = retrieve_section(*index, selection, line);
        ASSERT_EQ(text(found), text(expected)) << "run " << run << ", " << points.size() << " points, gap " << gap
                                               << ", from " << a.x << " " << a.y << " to " << b.x << " " << b.y;
        const CrossSection back = retrieve_section(*index, selection, SectionLine(grid, b, a));
        ASSERT_EQ(text(mirrored(back)), text(found));
        ASSERT_EQ(text(tiled_section(tiles, line)), text(found)) << "run " << run;
        // No block is read twice.
        ASSERT_LE(found.statistics.points_read, points.size());
        with_gaps += found.gaps.empty() ? 0 : 1;
        pieces += found.breakpoints.size();
      }
    }
  }
  // Otherwise nothing was tested.
  EXPECT_GT(with_gaps, 100u);
  EXPECT_GT(pieces, 1000u);
}

INSTANTIATE_TEST_SUITE_P(CrossSection, SectionPatterns,
                         testing::Values(Pattern::kRandom, Pattern::kLattice, Pattern::kClusters, Pattern::kContours));

TEST(SectionSurface, TakesNoStoreThatIsGoneTheNextMoment) {
  static_assert(std::is_constructible_v<SectionSurface, const Store&, Detail>);
  static_assert(!std::is_constructible_v<SectionSurface, Store, Detail>);
  static_assert(!std::is_constructible_v<SectionSurface, Store, Detail, ThemeChoice, SectionSurface::Options>);
}

}  // namespace
}  // namespace itin
