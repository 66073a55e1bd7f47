#include "features/ground_coverage.hpp"

#include <algorithm>

#include "features/plan/hot_pixel.hpp"
#include "features/plan/mask_index.hpp"
#include "triangulate/apex/apex.hpp"

namespace itin {

namespace {

/// Tells whether closed segments touch.
bool touch(const Segment& s, Position p, Position q) {
  const Position a = s.a(), b = s.b();
  return crosses(s, p, q) || on_segment(a, b, p) || on_segment(a, b, q) || on_segment(p, q, a) || on_segment(p, q, b);
}

}  // namespace

std::vector<Segment> outline_near(const Store& ground, const GridBox& box) {
  std::vector<Segment> segments;
  ground.points().outline(box, segments);
  return segments;
}

bool lies_on_ground(const GridPolygon& polygon, const std::vector<Segment>& outline, const TerrainHeights& terrain) {
  const GridBox box = box_about(polygon);
  for (const Segment& s : outline) {
    if (!extent_of(s).meets(box)) continue;
    bool meets = side_of(polygon, s.a()) != Side::outside;
    for_each_edge(polygon, [&](Position a, Position b) { meets = meets || touch(s, a, b); });
    if (meets) return false;
  }
  return terrain.height_at(polygon.outline.front()).has_value();
}

}  // namespace itin
