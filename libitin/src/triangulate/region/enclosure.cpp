#include "triangulate/region/enclosure.hpp"

#include <algorithm>
#include <cmath>

#include <itin/box_of.hpp>

namespace itin {

namespace {

/// The most cones to follow: with more, a search among the unread vertices is as fast.
constexpr std::size_t kMostCones = 2000;

/// Tells whether segment pq may meet the circle `lambda`: false only when it surely does not.
bool may_meet(const ApexFrame& frame, double lambda, Position p, Position q) {
  const double px = p.x - frame.mx, py = p.y - frame.my;
  const double dx = static_cast<double>(q.x) - p.x, dy = static_cast<double>(q.y) - p.y;
  // This is the point nearest to the centre. A point a little off it, by rounding, is hardly farther away.
  const double along = (lambda * frame.nx - px) * dx + (lambda * frame.ny - py) * dy;
  const double s = std::clamp(along / (dx * dx + dy * dy), 0.0, 1.0);
  return frame.inside(lambda, p.x + s * dx, p.y + s * dy);
}

struct Point {
  double x, y;
};

std::vector<Point> corners_of(const GridBox& b) {
  const double x0 = b.xmin, y0 = b.ymin, x1 = b.xmax, y1 = b.ymax;
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// Cuts off the parts that lie more than a grid unit to the right of pq (I. Sutherland, G. Hodgman 1974).
void keep_left_of(std::vector<Point>& polygon, Position p, Position q) {
  const double dx = static_cast<double>(q.x) - p.x, dy = static_cast<double>(q.y) - p.y;
  const double unit = std::hypot(dx, dy);
  const auto side = [&](const Point& c) { return dx * (c.y - p.y) - dy * (c.x - p.x) + unit; };
  std::vector<Point> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double before = side(from), after = side(to);
    if (before >= 0) kept.push_back(from);
    if ((before < 0) != (after < 0)) {
      const double share = before / (before - after);
      kept.push_back({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
    }
  }
  polygon = std::move(kept);
}

std::int32_t rounded_coordinate(double v) {
  return static_cast<std::int32_t>(std::lround(v));
}

}  // namespace

/// Tells whether the part of triangle t within the limit is known ground. If not, notes the unknown ground about
/// `near`, which matters most: over unknown ground triangles are large, and become small once the ground is known.
bool Enclosure::known(std::uint32_t t, const GridBox& limit, const GridBox& near) {
  const GridBox box = intersection(box_of(std::array{corner(t, 0), corner(t, 1), corner(t, 2)}), limit);
  if (known_.covers(box)) return true;
  for (double margin = 0; known_.covers(unknown_ = intersection(expanded(near, margin), box));
       margin = std::max(2 * margin, known_.cell_side())) {
  }
  return false;
}

bool Enclosure::add_missing(std::vector<Cell>& cells) const {
  return !unknown_.empty() && known_.add_missing(unknown_, cells);
}

bool Enclosure::holds(std::uint32_t t) {
  if (!known(t, all_, all_)) return false;
  for (int i = 0; i < 3; ++i) {
    if ((mesh_.constrained[t] >> i & 1) != 0) continue;
    if (!shut_in(t, i, End::kFirst) && !shut_in(t, i, End::kSecond)) return false;
  }
  return true;
}

bool Enclosure::shut_in(std::uint32_t t, int edge, End end) {
  // The side beyond the edge is left of ab.
  const Position a = corner(t, edge + 2), b = corner(t, edge + 1), eye = end == End::kFirst ? a : b;
  const ApexFrame frame(a, b);
  const double lambda = frame.lambda(corner(t, edge));
  const GridBox limit = frame.cap_box(lambda, all_);
  unknown_ = {};
  cones_.clear();
  // Visits the triangles about the eye, from the edge on, as long as they are left of ab.
  for (std::uint32_t u = mesh_.neighbours[t][edge];;) {
    if (u == kNoTriangle || !known(u, limit, box_of(std::array{a, b}))) return false;
    int k = 0;
    while (corner(u, k) != eye) ++k;
    see_through(u, k, corner(u, k + 1), corner(u, k + 2));
    const int on = end == End::kFirst ? 2 : 1;
    if (orientation(a, b, corner(u, k + on)) <= 0) break;
    u = mesh_.neighbours[u][(k + 3 - on) % 3];
  }
  return follow(eye, frame, lambda, limit);
}

/// Notes the cone in which the triangle beyond an edge of t is seen, unless the edge is constrained.
void Enclosure::see_through(std::uint32_t t, int edge, Position right, Position left) {
  if ((mesh_.constrained[t] >> edge & 1) == 0) cones_.push_back({t, edge, right, left});
}

/// Tells whether the area seen beyond an edge of the hull is known ground. There are no vertices in it.
bool Enclosure::known_beyond_hull(Position eye, const Cone& cone, const GridBox& limit) {
  std::vector<Point> seen = corners_of(expanded(limit, 1));
  keep_left_of(seen, corner(cone.triangle, cone.edge + 2), corner(cone.triangle, cone.edge + 1));
  keep_left_of(seen, eye, cone.right);
  keep_left_of(seen, cone.left, eye);
  GridBox box;
  for (const Point& p : seen) box.extend(rounded_coordinate(p.x), rounded_coordinate(p.y));
  unknown_ = intersection(expanded(box, 1), limit);
  return known_.covers(unknown_);
}

bool Enclosure::follow(Position eye, const ApexFrame& frame, double lambda, const GridBox& limit) {
  std::size_t next = 0;
  while (next < cones_.size()) {
    const Cone cone = cones_[next++];
    const auto& [from, edge, right, left] = cone;
    if (!may_meet(frame, lambda, corner(from, edge + 1), corner(from, edge + 2))) continue;
    const std::uint32_t u = mesh_.neighbours[from][edge];
    if (u == kNoTriangle) {
      if (!known_beyond_hull(eye, cone, limit)) return false;
      continue;
    }
    if (cones_.size() > kMostCones ||
        !known(u, limit, box_of(std::array{corner(from, edge + 1), corner(from, edge + 2)})))
      return false;
    int j = 0;
    while (mesh_.neighbours[u][j] != from) ++j;
    const Position apex = corner(u, j);
    // One edge runs from the entry's right end to the apex, and the other from there to its left end.
    const Position leftmost = orientation(eye, apex, left) > 0 ? apex : left;
    const Position rightmost = orientation(eye, right, apex) > 0 ? apex : right;
    if (orientation(eye, right, leftmost) >= 0) see_through(u, (j + 1) % 3, right, leftmost);
    if (orientation(eye, rightmost, left) >= 0) see_through(u, (j + 2) % 3, rightmost, left);
  }
  return true;
}

}  // namespace itin
