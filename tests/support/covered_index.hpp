// An index over points with holes in their coverage, the outline computed as an import does.
#pragma once

#include <set>

#include "pyramid/coverage/coverage.hpp"
#include "support/points.hpp"

namespace itin::test {

/// Surveys the outline: ground lies where triangles' edges are short, up to `gap` in x and in y.
inline void survey_outline(TestIndex& index, int levels, double gap) {
  std::vector<Segment> edges;
  std::vector<std::uint64_t> isolated;
  for (const CurveRange& tile : index->tiles(200)) {
    const TileSurvey survey = survey_tile(*index, tile, {{gap, 0, 0, gap}});
    edges.insert(edges.end(), survey.outline.begin(), survey.outline.end());
    isolated.insert(isolated.end(), survey.isolated.begin(), survey.isolated.end());
  }
  index->drop(std::move(isolated));
  const std::vector<Segment> outline = join_collinear(edges);
  index->set_segments(outline);
  for (const Segment& s : outline) index->promote({{morton(s.ax, s.ay), levels - 1}, {morton(s.bx, s.by), levels - 1}});
}

/// Cuts discs of some gaps' size out of the points.
inline void cut_holes(std::vector<GridPoint>& points, double gap, std::mt19937& random) {
  GridBox box;
  for (const GridPoint& p : points) box.extend(p.x, p.y);
  for (int i = 0; i < 3; ++i) {
    const std::int64_t x = box.xmin + static_cast<int>(random() % static_cast<unsigned>(box.xmax - box.xmin + 1));
    const std::int64_t y = box.ymin + static_cast<int>(random() % static_cast<unsigned>(box.ymax - box.ymin + 1));
    std::erase_if(points, [&](const GridPoint& p) {
      return static_cast<double>((p.x - x) * (p.x - x) + (p.y - y) * (p.y - y)) < 6 * gap * gap;
    });
  }
}

}  // namespace itin::test
