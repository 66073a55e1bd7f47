// What lines change that were put back, against both triangulations of everything.
#include "pyramid/levels/changed_by_lines.hpp"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include <itin/box_of.hpp>

#include "features/contours/line_hierarchy.hpp"
#include "support/points.hpp"
#include "support/seed.hpp"
#include "triangulate/region/region.hpp"

namespace itin {
namespace {

using Corners = std::array<Position, 3>;

/// Wobbly rings about each other, like contours, and points between that are no obstacles to shortcuts: lines hide
/// those that shortcuts do not.
class Rings {
 public:
  explicit Rings(std::mt19937& random) {
    for (int ring = 1; ring <= 8; ++ring) {
      std::vector<Position> line;
      const int count = 30 + static_cast<int>(random() % 120);
      for (int i = 0; i < count; ++i) {
        const double angle = 2 * M_PI * i / count;
        const double radius = 1000 * ring + 200 * std::sin(3 * angle + ring) + static_cast<double>(random() % 200);
        line.push_back({static_cast<std::int32_t>(std::lround(radius * std::cos(angle))),
                        static_cast<std::int32_t>(std::lround(radius * std::sin(angle)))});
      }
      for (int i = 0; i < count; ++i) {
        const auto [a, b] =
            std::minmax(line[static_cast<std::size_t>(i)], line[static_cast<std::size_t>((i + 1) % count)]);
        segments.push_back({a.x, a.y, b.x, b.y, 1});
        points.push_back({{a.x, a.y, 0}, 0});
        points.push_back({{b.x, b.y, 0}, 0});
      }
    }
    const auto in = [&] { return static_cast<std::int32_t>(random() % 18001) - 9000; };
    for (int i = 0; i < 4000; ++i) points.push_back({{in(), in(), 0}, static_cast<int>(random() % 4 > 0)});
    const auto place = [](const test::LevelPoint& p) { return std::pair(p.point.x, p.point.y); };
    std::sort(points.begin(), points.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
    points.erase(
        std::unique(points.begin(), points.end(), [&](const auto& a, const auto& b) { return place(a) == place(b); }),
        points.end());
  }

  LineHierarchy lines() const {
    return LineHierarchy(segments, {}, {}, [](Position) { return 0; }, {{0, 0}, {300, 300}});
  }

  std::vector<Segment> segments;
  std::vector<test::LevelPoint> points;
};

void set_lines(WorkingIndex& index, const LineHierarchy& lines) {
  for (const auto& [code, level] : lines.levels()) index.promote({{code, level}});
  index.set_segments(lines.segments());
}

std::set<Corners> triangles(const WorkingIndex& index, const Selection& selection) {
  std::set<Corners> result;
  const RegionMesh mesh = triangulate_region(index, selection, index.bounds());
  for (const auto& [a, b, c] : mesh.mesh.triangles) {
    Corners corners{mesh.vertices[a].position(), mesh.vertices[b].position(), mesh.vertices[c].position()};
    std::sort(corners.begin(), corners.end());
    result.insert(corners);
  }
  return result;
}

TEST(ChangedByLines, HasAllTrianglesThatAreNew) {
  std::mt19937 random(test::seed());
  const std::vector<double> tolerances{0, 1};
  const Selection coarse(Detail::tolerance(1), tolerances, Grid{});
  std::size_t fresh = 0, beside = 0, untouched = 0;
  for (int run = 0; run < 40; ++run) {
    const Rings rings(random);
    LineHierarchy lines = rings.lines();
    test::TestIndex index(rings.points, 2, 16 + static_cast<std::uint32_t>(random() % 64));
    set_lines(*index, lines);
    const std::set<Corners> before = triangles(*index, coarse);

    std::vector<LineHierarchy::Shortcut> shortcuts;
    for (const Segment& s : lines.segments())
      if (s.finest == 1 && random() % 8 == 0) shortcuts.push_back({1, {s.ax, s.ay}, {s.bx, s.by}});
    std::sort(shortcuts.begin(), shortcuts.end());
    std::vector<GridBox> boxes;
    for (const LineHierarchy::Restored& r : lines.restore(shortcuts)) boxes.push_back(r.box);
    if (boxes.empty()) continue;
    ASSERT_EQ(boxes.size(), shortcuts.size());
    set_lines(*index, lines);

    const std::vector<GridBox> changed = changed_by_lines(*index, coarse, boxes);
    ASSERT_EQ(changed.size(), boxes.size());
    for (const Corners& t : triangles(*index, coarse)) {
      const GridBox box = box_of(t);
      const auto holds = [&](const GridBox& b) { return b.contains(box); };
      const bool is_new = !before.contains(t), known = std::any_of(changed.begin(), changed.end(), holds);
      EXPECT_TRUE(known || !is_new) << "run " << run << ": a triangle at " << t[0].x << ", " << t[0].y;
      fresh += is_new;
      beside += is_new && std::none_of(boxes.begin(), boxes.end(), [&](const GridBox& b) { return b.meets(box); });
      untouched += !known;
    }
  }
  EXPECT_GT(fresh, 1000u);
  EXPECT_GT(beside, 0u) << "no triangle was new but at a line itself";
  EXPECT_GT(untouched, fresh) << "as good as everything was taken for changed";
}

}  // namespace
}  // namespace itin
