#include "triangulate/enclosure.hpp"

#include <algorithm>
#include <cmath>

namespace itin {

namespace {

/// For more, a search among the unread vertices is as fast.
constexpr std::size_t kMostCones = 2000;
/// Circles of so many cells' sides hold more points than what is seen of them.
constexpr double kWide = 2;

/// Whether segment pq may meet the circle `lambda`: surely false only when it does not.
bool may_meet(const ApexFrame& frame, double lambda, Position p, Position q) {
  const double px = p.x - frame.mx, py = p.y - frame.my;
  const double dx = static_cast<double>(q.x) - p.x, dy = static_cast<double>(q.y) - p.y;
  // The point nearest to the centre; a little off it, a point is hardly farther away.
  const double along = (lambda * frame.nx - px) * dx + (lambda * frame.ny - py) * dy;
  const double s = std::clamp(along / (dx * dx + dy * dy), 0.0, 1.0);
  return frame.inside(lambda, p.x + s * dx, p.y + s * dy);
}

GridBox box_of(Position p, Position q) {
  GridBox box;
  box.extend(p.x, p.y);
  box.extend(q.x, q.y);
  return box;
}

}  // namespace

/// Whether the part of triangle t within the limit is known ground. If not, that about `near` is what lacks most: over
/// unknown ground triangles are large, and become small once it is known.
bool Enclosure::known(std::uint32_t t, const GridBox& limit, const GridBox& near) {
  GridBox box;
  for (int i = 0; i < 3; ++i) box.extend(corner(t, i).x, corner(t, i).y);
  box = intersection(box, limit);
  if (known_.covers(box)) return true;
  for (double margin = 0; known_.covers(unknown_ = intersection(expanded(near, margin), box));
       margin = std::max(2 * margin, known_.cell_side())) {
  }
  return false;
}

bool Enclosure::add_missing(std::vector<Cell>& cells) const {
  return radius_ > kWide * known_.cell_side() && !unknown_.empty() && known_.add_missing(unknown_, cells);
}

bool Enclosure::holds(std::uint32_t t) {
  radius_ = 0;
  if (!known(t, all_, all_)) return false;
  for (int i = 0; i < 3; ++i) {
    if ((mesh_.constrained[t] >> i & 1) != 0) continue;
    if (!shut_in(t, i, End::kFirst) && !shut_in(t, i, End::kSecond)) return false;
  }
  return true;
}

bool Enclosure::shut_in(std::uint32_t t, int edge, End end) {
  // What lies beyond the edge is left of ab.
  const Position a = corner(t, edge + 2), b = corner(t, edge + 1), eye = end == End::kFirst ? a : b;
  const ApexFrame frame(a, b);
  const double lambda = frame.lambda(corner(t, edge));
  const GridBox limit = frame.cap_box(lambda, all_);
  radius_ = std::hypot(frame.r, lambda);
  unknown_ = {};
  cones_.clear();
  // The triangles about the eye, from the edge on, as long as they are left of ab.
  for (std::uint32_t u = mesh_.neighbours[t][edge];;) {
    if (u == kNoTriangle || !known(u, limit, box_of(a, b))) return false;
    int k = 0;
    while (corner(u, k) != eye) ++k;
    look_through(u, k, corner(u, k + 1), corner(u, k + 2));
    const int on = end == End::kFirst ? 2 : 1;
    if (orientation(a, b, corner(u, k + on)) <= 0) break;
    u = mesh_.neighbours[u][(k + 3 - on) % 3];
  }
  return follow(eye, frame, lambda, limit);
}

/// Notes what is seen of the triangle beyond an edge of t.
void Enclosure::look_through(std::uint32_t t, int edge, Position right, Position left) {
  if ((mesh_.constrained[t] >> edge & 1) == 0) cones_.push_back({t, edge, right, left});
}

bool Enclosure::follow(Position eye, const ApexFrame& frame, double lambda, const GridBox& limit) {
  for (std::size_t next = 0; next < cones_.size(); ++next) {
    const auto [from, edge, right, left] = cones_[next];
    if (!may_meet(frame, lambda, corner(from, edge + 1), corner(from, edge + 2))) continue;
    const std::uint32_t u = mesh_.neighbours[from][edge];
    if (u == kNoTriangle || cones_.size() > kMostCones ||
        !known(u, limit, box_of(corner(from, edge + 1), corner(from, edge + 2))))
      return false;
    int j = 0;
    while (mesh_.neighbours[u][j] != from) ++j;
    const Position apex = corner(u, j);
    // The edge from the entry's right end to the apex, and from there to its left end.
    const Position leftmost = orientation(eye, apex, left) > 0 ? apex : left;
    const Position rightmost = orientation(eye, right, apex) > 0 ? apex : right;
    if (orientation(eye, right, leftmost) >= 0) look_through(u, (j + 1) % 3, right, leftmost);
    if (orientation(eye, rightmost, left) >= 0) look_through(u, (j + 2) % 3, rightmost, left);
  }
  return true;
}

}  // namespace itin
