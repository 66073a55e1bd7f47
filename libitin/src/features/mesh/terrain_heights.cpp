#include "features/mesh/terrain_heights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <itin/box_of.hpp>
#include <itin/sort_unique.hpp>

#include "base/stoppable.hpp"
#include "features/plan/mask_index.hpp"

namespace itin {

namespace {

/// The height at (x, y) of the plane through a triangle, grid units.
double plane_height(const GridPoint& a, const GridPoint& b, const GridPoint& c, double x, double y) {
  const double abx = double{1} * b.x - a.x, aby = double{1} * b.y - a.y;
  const double acx = double{1} * c.x - a.x, acy = double{1} * c.y - a.y;
  const double det = abx * acy - aby * acx, px = x - a.x, py = y - a.y;
  const double s = (px * acy - py * acx) / det, t = (abx * py - aby * px) / det;
  return a.z + s * (double{1} * b.z - a.z) + t * (double{1} * c.z - a.z);
}

struct Integral {
  double area = 0, x = 0, y = 0;  ///< the area and its first moments
};

/// The integral over a closed ring about `origin`; signed, counterclockwise positive.
Integral integral(const std::vector<Point2>& ring, Point2 origin) {
  Integral sum;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point2 p{ring[i].x - origin.x, ring[i].y - origin.y};
    const Point2& next = ring[(i + 1) % ring.size()];
    const Point2 q{next.x - origin.x, next.y - origin.y};
    const double cross = p.x * q.y - p.y * q.x;
    sum.area += cross / 2;
    sum.x += cross * (p.x + q.x) / 6;
    sum.y += cross * (p.y + q.y) / 6;
  }
  return sum;
}

/// Clips a ring to the left of ab (Sutherland and Hodgman). A ring that enters several times comes out as one with
/// coinciding edges there and back, which makes no difference to an integral.
void clip_to_half_plane(std::vector<Point2>& ring, Point2 a, Point2 b) {
  const auto side = [&](const Point2& p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
  std::vector<Point2> kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point2 &p = ring[i], &q = ring[(i + 1) % ring.size()];
    const double sp = side(p), sq = side(q);
    if (sp >= 0) kept.push_back(p);
    if ((sp > 0 && sq < 0) || (sp < 0 && sq > 0)) {
      const double t = sp / (sp - sq);
      kept.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
  }
  ring = std::move(kept);
}

}  // namespace

struct TerrainHeights::Extremes {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double z) { low = std::min(low, z), high = std::max(high, z); }
};

GridBox bounds_of(const GridPolygons& polygons) {
  GridBox box;
  for (const GridPolygon& polygon : polygons) box.extend(box_of(polygon.outline));
  return box;
}

TerrainHeights::TerrainHeights(const Tin& tin) : tin_(&tin), bounds_(box_of(tin.vertices)) {
  if (tin.triangles.empty() || bounds_.empty()) return;
  const double width = double{1} * bounds_.xmax - bounds_.xmin, height = double{1} * bounds_.ymax - bounds_.ymin;
  const double side = std::sqrt(2 * width * height / static_cast<double>(tin.triangles.size()));
  bucket_side_ = std::max<std::int64_t>(1, static_cast<std::int64_t>(side));
  columns_ = static_cast<std::int32_t>(static_cast<std::int64_t>(width) / bucket_side_ + 1);
  rows_ = static_cast<std::int32_t>(static_cast<std::int64_t>(height) / bucket_side_ + 1);
  fill_buckets();
}

/// Columns and rows of the buckets that a box meets; empty if none.
GridBox TerrainHeights::bucket_range(const GridBox& box) const {
  if (columns_ == 0 || !box.meets(bounds_)) return {};
  const auto at = [&](std::int64_t v, std::int64_t origin, std::int32_t count) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>((v - origin) / bucket_side_, 0, count - 1));
  };
  return {at(box.xmin, bounds_.xmin, columns_), at(box.ymin, bounds_.ymin, rows_), at(box.xmax, bounds_.xmin, columns_),
          at(box.ymax, bounds_.ymin, rows_)};
}

void TerrainHeights::fill_buckets() {
  triangles_ = {static_cast<std::size_t>(columns_) * rows_, tin_->triangles.size(),
                [&](std::uint32_t t, const auto& add) {
                  const GridBox range = bucket_range(box_of_triangle(t));
                  for (std::int32_t r = range.ymin; r <= range.ymax; ++r)
                    for (std::int32_t c = range.xmin; c <= range.xmax; ++c) add(bucket(c, r));
                }};
}

std::vector<std::uint32_t> TerrainHeights::triangles_near(const GridBox& box) const {
  std::vector<std::uint32_t> found;
  const GridBox range = bucket_range(box);
  if (range.empty()) return found;
  for (std::int32_t r = range.ymin; r <= range.ymax; ++r) {
    for (std::int32_t c = range.xmin; c <= range.xmax; ++c) {
      for (const std::uint32_t t : triangles_.in(bucket(c, r))) {
        const GridBox own = box_of_triangle(t);
        if (!box.meets(own)) continue;
        // A triangle counts in the first of the buckets that list it.
        const GridBox all = bucket_range(own);
        if (c == std::max(all.xmin, range.xmin) && r == std::max(all.ymin, range.ymin)) found.push_back(t);
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

bool TerrainHeights::level_about(const GridBox& box) const {
  const GridBox range = bucket_range(box);
  std::optional<std::int32_t> height;
  for (std::int32_t r = range.ymin; r <= range.ymax && !range.empty(); ++r) {
    for (std::int32_t c = range.xmin; c <= range.xmax; ++c) {
      for (const std::uint32_t t : triangles_.in(bucket(c, r))) {
        for (const std::uint32_t v : tin_->triangles[t]) {
          if (height && *height != vertex(v).z) return false;
          height = vertex(v).z;
        }
      }
    }
  }
  return true;
}

namespace {

/// Whether p lies more than `reach` to the right of the line from s to t.
bool beyond(Position s, Position t, Position p, std::int64_t reach) {
  const std::int64_t length = std::abs(std::int64_t{t.x} - s.x) + std::abs(std::int64_t{t.y} - s.y);  // at least
  return doubled_area(s, t, p) < -reach * length;
}

/// Whether a side of the triangle, or the segment, tells that they are more than `reach` apart.
bool separated(const std::array<Position, 3>& triangle, Position p, Position q, std::int64_t reach) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Position &s = triangle[i], &t = triangle[(i + 1) % 3];
    if (beyond(s, t, p, reach) && beyond(s, t, q, reach)) return true;
  }
  const auto all_beyond = [&](Position s, Position t) {
    return std::all_of(triangle.begin(), triangle.end(), [&](Position v) { return beyond(s, t, v, reach); });
  };
  return all_beyond(p, q) || all_beyond(q, p);
}

}  // namespace

std::vector<std::uint32_t> TerrainHeights::triangles_along(Position a, Position b, std::int32_t reach) const {
  // The segment is taken piece by piece: the box of a long slanting one holds many more triangles than it meets.
  const std::int64_t dx = std::int64_t{b.x} - a.x, dy = std::int64_t{b.y} - a.y;
  const std::int64_t pieces = std::max(std::abs(dx), std::abs(dy)) / (4 * bucket_side_) + 1;
  std::vector<std::uint32_t> found;
  for (std::int64_t i = 0; i < pieces; ++i) {
    GridBox box;
    for (const std::int64_t k : {i, i + 1})
      box.extend(static_cast<std::int32_t>(a.x + dx * k / pieces), static_cast<std::int32_t>(a.y + dy * k / pieces));
    for (const std::uint32_t t : triangles_near(expanded(box, reach + 1))) {
      const Triangle& v = tin_->triangles[t];
      const auto at = [&](std::size_t k) { return Position{vertex(v[k]).x, vertex(v[k]).y}; };
      if (!separated({at(0), at(1), at(2)}, a, b, reach)) found.push_back(t);
    }
  }
  sort_unique(found);
  return found;
}

std::optional<double> TerrainHeights::height_at(Position p) const {
  const GridBox range = bucket_range({p.x, p.y, p.x, p.y});
  if (range.empty()) return std::nullopt;
  for (const std::uint32_t t : triangles_.in(bucket(range.xmin, range.ymin))) {
    const Triangle& v = tin_->triangles[t];
    const GridPoint &a = vertex(v[0]), &b = vertex(v[1]), &c = vertex(v[2]);
    if (orientation(a, b, p) < 0 || orientation(b, c, p) < 0 || orientation(c, a, p) < 0) continue;
    for (const GridPoint* q : {&a, &b, &c})
      if (q->x == p.x && q->y == p.y) return q->z * grid().resolution;
    return plane_height(a, b, c, p.x, p.y) * grid().resolution;
  }
  return std::nullopt;
}

/// The crossings in order from a; one at an edge of two triangles is found twice.
std::vector<TerrainHeights::Crossing> TerrainHeights::all_crossings(Position a, Position b) const {
  const double dx = double{1} * b.x - a.x, dy = double{1} * b.y - a.y;
  std::vector<Crossing> found;
  for (const std::uint32_t t : triangles_along(a, b)) {
    const Triangle& v = tin_->triangles[t];
    for (int i = 0; i < 3; ++i) {
      const GridPoint &p = vertex(v[i]), &q = vertex(v[(i + 1) % 3]);
      const std::int64_t sp = doubled_area(a, b, p), sq = doubled_area(a, b, q);
      if (sp == 0) {
        const double along = (dx * (double{1} * p.x - a.x) + dy * (double{1} * p.y - a.y)) / (dx * dx + dy * dy);
        if (along > 0 && along < 1) found.push_back({along, {p.x, p.y}, double{1} * p.z});
      }
      if ((sp > 0) == (sq > 0) || sp == 0 || sq == 0) continue;
      const std::int64_t sa = doubled_area(p, q, a), sb = doubled_area(p, q, b);
      if (sa == 0 || sb == 0 || (sa > 0) == (sb > 0)) continue;
      const double along = static_cast<double>(sa) / (static_cast<double>(sa) - static_cast<double>(sb));
      const double part = static_cast<double>(sp) / (static_cast<double>(sp) - static_cast<double>(sq));
      found.push_back({along,
                       {static_cast<std::int32_t>(std::llround(a.x + along * dx)),
                        static_cast<std::int32_t>(std::llround(a.y + along * dy))},
                       p.z + part * (double{1} * q.z - p.z)});
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<Position> TerrainHeights::crossings(Position a, Position b) const {
  std::vector<Position> ordered;
  for (const Crossing& c : all_crossings(a, b))
    if (c.at != a && c.at != b && (ordered.empty() || ordered.back() != c.at)) ordered.push_back(c.at);
  return ordered;
}

/// The integral of the triangulation over a footprint. Where both are large, each quarter of their box is taken by
/// itself, so that a triangle is combined with edges near it alone.
class TerrainHeights::FootprintIntegral {
 public:
  using Rings = std::vector<std::vector<Point2>>;
  explicit FootprintIntegral(const TerrainHeights& terrain) : terrain_(terrain) {}

  void add(const GridBox& box, const Rings& rings, const std::vector<std::uint32_t>& triangles) {
    std::size_t corners = 0;
    for (const auto& ring : rings) corners += ring.size();
    const bool small = box.xmax - box.xmin <= 1 || box.ymax - box.ymin <= 1;
    if (corners <= kFewCorners || triangles.size() <= kFewTriangles || small) return add(rings, triangles);
    const std::int32_t x = box.xmin + (box.xmax - box.xmin) / 2, y = box.ymin + (box.ymax - box.ymin) / 2;
    for (const GridBox& part : {GridBox{box.xmin, box.ymin, x, y}, GridBox{x, box.ymin, box.xmax, y},
                                GridBox{box.xmin, y, x, box.ymax}, GridBox{x, y, box.xmax, box.ymax}})
      add_part(part, rings, triangles);
  }

  /// The mean height in metres; nothing where no triangle meets the footprint.
  std::optional<double> mean() const {
    if (area_ <= 0) return std::nullopt;
    return volume_ / area_ * terrain_.grid().resolution;
  }

 private:
  static constexpr std::size_t kFewCorners = 256, kFewTriangles = 8;

  static std::array<Point2, 4> corners_of(const GridBox& box) {
    const Point2 low{1.0 * box.xmin, 1.0 * box.ymin}, high{1.0 * box.xmax, 1.0 * box.ymax};
    return {low, {high.x, low.y}, high, {low.x, high.y}};
  }

  template <std::size_t N>
  static void clip(std::vector<Point2>& ring, const std::array<Point2, N>& corners) {
    for (std::size_t i = 0; i < N && !ring.empty(); ++i) clip_to_half_plane(ring, corners[i], corners[(i + 1) % N]);
  }

  void add_part(const GridBox& part, const Rings& rings, const std::vector<std::uint32_t>& triangles) {
    Rings clipped;
    for (std::vector<Point2> ring : rings) {
      stop_if_asked();
      clip(ring, corners_of(part));
      if (!ring.empty()) clipped.push_back(std::move(ring));
    }
    if (clipped.empty()) return;
    std::vector<std::uint32_t> met;
    for (const std::uint32_t t : triangles) {
      if (terrain_.box_of_triangle(t).meets(part)) met.push_back(t);
    }
    add(part, clipped, met);
  }

  void add(const Rings& rings, const std::vector<std::uint32_t>& triangles) {
    for (const std::uint32_t t : triangles) {
      stop_if_asked();
      const Triangle& v = terrain_.triangle(t);
      const GridPoint &a = terrain_.vertex(v[0]), &b = terrain_.vertex(v[1]), &c = terrain_.vertex(v[2]);
      const std::array<Point2, 3> corner{Point2{1.0 * a.x, 1.0 * a.y}, {1.0 * b.x, 1.0 * b.y}, {1.0 * c.x, 1.0 * c.y}};
      Integral part;
      for (std::vector<Point2> ring : rings) {
        clip(ring, corner);
        const Integral piece = integral(ring, corner[0]);
        part.area += piece.area, part.x += piece.x, part.y += piece.y;
      }
      if (part.area <= 0) continue;
      area_ += part.area;
      // The integral of a linear function is the area times its value at the centroid.
      volume_ += part.area * plane_height(a, b, c, corner[0].x + part.x / part.area, corner[0].y + part.y / part.area);
    }
  }

  const TerrainHeights& terrain_;
  double area_ = 0, volume_ = 0;
};

std::optional<double> TerrainHeights::mean_height(const GridPolygons& footprint,
                                                  const std::vector<std::uint32_t>& near) const {
  FootprintIntegral::Rings rings;
  for (const GridPolygon& polygon : footprint) {
    for_each_ring(polygon, [&](const GridRing& outline) {
      std::vector<Point2>& ring = rings.emplace_back();
      for (const Position& p : outline) ring.push_back({1.0 * p.x, 1.0 * p.y});
    });
  }
  FootprintIntegral integral(*this);
  integral.add(bounds_of(footprint), rings, near);
  return integral.mean();
}

void TerrainHeights::add_outline(const GridPolygons& footprint, Extremes& extremes) const {
  for (const GridPolygon& polygon : footprint) {
    for_each_edge(polygon, [&](Position a, Position b) {
      stop_if_asked();
      if (const auto z = height_at(a)) extremes.add(*z);
      for (const Crossing& c : all_crossings(a, b)) extremes.add(c.height * grid().resolution);
    });
  }
}

std::optional<double> TerrainHeights::base_height(const GridPolygons& footprint, BaseRule rule) const {
  const std::vector<std::uint32_t> near = triangles_near(bounds_of(footprint));
  if (rule == BaseRule::mean || rule == BaseRule::terrain_following) return mean_height(footprint, near);
  Extremes extremes;
  add_outline(footprint, extremes);
  std::vector<std::uint32_t> vertices;
  for (const std::uint32_t t : near) vertices.insert(vertices.end(), triangle(t).begin(), triangle(t).end());
  sort_unique(vertices);
  const MaskIndex inside(footprint);
  for (const std::uint32_t v : vertices) {
    stop_if_asked();
    if (inside.strictly_inside({vertex(v).x, vertex(v).y})) extremes.add(vertex(v).z * grid().resolution);
  }
  if (extremes.low > extremes.high) return std::nullopt;
  return rule == BaseRule::minimum ? extremes.low : extremes.high;
}

}  // namespace itin
