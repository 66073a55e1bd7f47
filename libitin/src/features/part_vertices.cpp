#include "features/part_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <itin/sort_unique.hpp>

#include "base/stoppable.hpp"
#include "geometry/cell.hpp"

namespace itin {

namespace {

struct Footing {
  double distance, z;
};

/// How far a position lies off a segment, grid units, and the segment's height next to it.
Footing footing(const RaisedSegment& segment, const GridPoint& p) {
  const GridPoint &a = segment.a, &b = segment.b;
  const double dx = 1.0 * b.x - a.x, dy = 1.0 * b.y - a.y, px = 1.0 * p.x - a.x, py = 1.0 * p.y - a.y;
  const double squared = dx * dx + dy * dy;
  const double t = squared > 0 ? std::clamp((px * dx + py * dy) / squared, 0.0, 1.0) : 0;
  return {std::hypot(px - t * dx, py - t * dy), a.z + t * (1.0 * b.z - a.z)};
}

}  // namespace

std::vector<PartVertex> part_vertices(const RaisedPart& part, const std::vector<Position>& ends) {
  constexpr std::int32_t kHeightUnknown = std::numeric_limits<std::int32_t>::min();
  std::vector<GridPoint> fresh;
  for (const Position& p : ends) {
    stop_if_asked();
    const GridPoint point{p.x, p.y, kHeightUnknown};
    if (!std::binary_search(part.vertices.begin(), part.vertices.end(), point, before_by_code)) fresh.push_back(point);
  }
  // Sorted by x, so that a segment finds the vertices beside it.
  sort_unique(fresh);
  std::vector<double> nearest(fresh.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> on_foot(fresh.size());
  std::vector<std::uint64_t> outline;
  for (const auto& segment : part.segments) {
    stop_if_asked();
    const auto [left, right] = std::minmax(segment.a.x, segment.b.x);
    const auto [low, high] = std::minmax(segment.a.y, segment.b.y);
    if (segment.outline) outline.insert(outline.end(), {code_of(segment.a), code_of(segment.b)});
    auto p = std::lower_bound(fresh.begin(), fresh.end(), left - 1,
                              [](const GridPoint& q, std::int32_t x) { return q.x < x; });
    for (; p != fresh.end() && p->x <= right + 1; ++p) {
      if (p->y < low - 1 || p->y > high + 1) continue;
      const auto [distance, z] = footing(segment, *p);
      const auto number = static_cast<std::size_t>(p - fresh.begin());
      double& least = nearest[number];
      // Snap rounding leads a segment through pixels that it meets: within half the diagonal of one.
      const bool on_it = distance <= 0.75;
      if (!on_it && distance >= least) continue;
      if (on_it && segment.outline) outline.push_back(code_of(*p));
      if (on_foot[number] && !segment.outline) continue;
      const auto height = static_cast<std::int32_t>(std::llround(z));
      const bool among_equals = on_it && least <= 0.75 && (on_foot[number] || !segment.outline);
      p->z = among_equals ? std::max(p->z, height) : height;
      least = std::min(least, distance);
      if (on_it && segment.outline) on_foot[number] = true;
    }
  }
  std::vector<GridPoint> all = part.vertices;
  all.insert(all.end(), fresh.begin(), fresh.end());
  std::sort(all.begin(), all.end(), before_by_code);
  std::erase_if(all, [](const GridPoint& p) { return p.z == kHeightUnknown; });
  std::sort(outline.begin(), outline.end());
  std::vector<PartVertex> result;
  for (const GridPoint& p : all) result.push_back({p, std::binary_search(outline.begin(), outline.end(), code_of(p))});
  return result;
}

}  // namespace itin
