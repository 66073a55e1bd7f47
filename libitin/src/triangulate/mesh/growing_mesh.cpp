#include "triangulate/mesh/growing_mesh.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include <itin/error.hpp>
#include <itin/precondition.hpp>
#include <itin/sort_unique.hpp>

namespace itin {

namespace {

constexpr auto kByEnds = [](const auto& a, const auto& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); };

/// Returns the edge in a sorted range; null where there is none.
template <class Edge>
const Edge* find(const std::vector<Edge>& edges, std::uint32_t from, std::uint32_t to) {
  const auto found = std::lower_bound(edges.begin(), edges.end(), std::pair(from, to),
                                      [](const Edge& e, const auto& p) { return std::pair(e.from, e.to) < p; });
  return found != edges.end() && found->from == from && found->to == to ? &*found : nullptr;
}

}  // namespace

void GrowingMesh::start(PlaneMesh mesh) {
  mesh_ = std::move(mesh);
  mesh_.constrained.assign(mesh_.triangles.size(), 0);
  proved_.assign(mesh_.triangles.size(), 0);
  changed_.clear();
  some_triangle_.assign(vertices_.size(), kNoTriangle);
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh_.triangles[t]) some_triangle_[v] = t;
  }
  last_ = 0;
}

std::vector<std::uint32_t> GrowingMesh::take_changed() {
  sort_unique(changed_);
  return std::exchange(changed_, {});
}

GrowingMesh::Side GrowingMesh::side(std::uint32_t t, int edge) const {
  return {corner(t, edge + 1), corner(t, edge + 2), mesh_.neighbours[t][edge], bits(t, edge)};
}

int GrowingMesh::edge_between(std::uint32_t t, std::uint32_t from, std::uint32_t to) const {
  int i = 0;
  while (corner(t, i) == from || corner(t, i) == to) ++i;
  return i;
}

bool GrowingMesh::disturbs(Position p, std::uint32_t t) const {
  return in_circle_perturbed(at_corner(t, 0), at_corner(t, 1), at_corner(t, 2), p) > 0;
}

void GrowingMesh::insert(std::uint32_t vertex) {
  ITIN_PRECONDITION(!mesh_.triangles.empty());
  insert(vertex, locate(position(vertex), last_));
}

void GrowingMesh::insert(std::uint32_t vertex, std::uint32_t triangle) {
  insert(vertex, Place{triangle, kInside});
}

void GrowingMesh::insert(std::uint32_t vertex, const Place& place) {
  some_triangle_.resize(std::max<std::size_t>(some_triangle_.size(), vertex + std::size_t{1}), kNoTriangle);
  clear();
  if (place.beyond == kInside) {
    take(place.triangle);
    split_edge_at(vertex);
  } else {
    take_beyond_hull(place, vertex);
  }
  take_disturbed(position(vertex));
  fan_out(vertex);
  replace_by_star(vertex);
}

/// Walks from one triangle to the next, beyond an edge that has p on its other side. Between two such edges it chooses
/// at random: a fixed choice could go in circles, as the triangulation is constrained.
GrowingMesh::Place GrowingMesh::locate(Position p, std::uint32_t near) {
  for (std::uint32_t t = near;;) {
    random_ = random_ * 1664525 + 1013904223;
    int edge = kInside;
    for (unsigned k = 0; k < 3 && edge == kInside; ++k) {
      const int i = static_cast<int>(((random_ >> 16) + k) % 3);
      if (orientation(at_corner(t, i + 1), at_corner(t, i + 2), p) < 0) edge = i;
    }
    if (edge == kInside || mesh_.neighbours[t][edge] == kNoTriangle) return {t, edge};
    t = mesh_.neighbours[t][edge];
  }
}

void GrowingMesh::clear() {
  cavity_.clear();
  rim_.clear();
  halves_.clear();
  filling_.clear();
}

void GrowingMesh::take(std::uint32_t t) {
  if (taken(t)) return;
  mesh_.constrained[t] |= kTaken;
  cavity_.push_back(t);
}

/// Where the vertex lies on an edge of the triangle taken, takes the triangle beyond, too. Both halves of a line stay.
void GrowingMesh::split_edge_at(std::uint32_t vertex) {
  const std::uint32_t t = cavity_.front();
  for (int i = 0; i < 3; ++i) {
    const Side edge = side(t, i);
    if (orientation(position(edge.from), position(edge.to), position(vertex)) != 0) continue;
    if (edge.outer != kNoTriangle) take(edge.outer);
    if (edge.bits == 0) continue;
    for (const std::uint32_t end : {edge.from, edge.to}) {
      halves_.push_back({end, vertex, kNoTriangle, edge.bits});
      halves_.push_back({vertex, end, kNoTriangle, edge.bits});
    }
  }
}

/// Takes, for all edges of the hull that the vertex sees, the triangle behind if the vertex disturbs it; otherwise
/// joins the edge to the vertex.
void GrowingMesh::take_beyond_hull(const Place& place, std::uint32_t vertex) {
  const Position p = position(vertex);
  const auto see = [&](std::uint32_t t, int i) {
    const Side edge = side(t, i);
    if (orientation(position(edge.from), position(edge.to), p) >= 0) return false;
    if (edge.bits == 0 && disturbs(p, t)) {
      take(t);
    } else {
      add_side({edge.to, edge.from, t, edge.bits}, vertex);
    }
    return true;
  };
  see(place.triangle, place.beyond);
  for (const int step : {1, 2}) {  // counterclockwise along the hull, and clockwise
    std::uint32_t t = place.triangle;
    int i = place.beyond;
    do {
      const std::uint32_t pivot = corner(t, i + 3 - step);
      for (i = (i + step) % 3; mesh_.neighbours[t][i] != kNoTriangle;) {
        t = mesh_.neighbours[t][i];
        for (i = 0; corner(t, i) != pivot;) ++i;
        i = (i + 3 - step) % 3;
      }
    } while (see(t, i));
  }
}

void GrowingMesh::take_disturbed(Position p) {
  std::size_t next = 0;
  while (next < cavity_.size()) {
    const std::uint32_t t = cavity_[next++];
    for (int i = 0; i < 3; ++i) {
      const Side edge = side(t, i);
      if (edge.bits == 0 && edge.outer != kNoTriangle && !taken(edge.outer) && disturbs(p, edge.outer))
        take(edge.outer);
    }
  }
}

void GrowingMesh::fan_out(std::uint32_t vertex) {
  for (const std::uint32_t t : cavity_) {
    for (int i = 0; i < 3; ++i) {
      const Side edge = side(t, i);
      if (edge.outer != kNoTriangle ? taken(edge.outer)
                                    : orientation(position(edge.from), position(edge.to), position(vertex)) <= 0)
        continue;
      add_side(edge, vertex);
    }
  }
}

void GrowingMesh::add_side(const Side& side, std::uint32_t vertex) {
  rim_.push_back(side);
  filling_.push_back({side.from, side.to, vertex});
}

/// Replaces the triangles of cavity_ by those of filling_, which are no fewer, each with its edge of rim_ and the
/// vertex as its last corner.
void GrowingMesh::replace_by_star(std::uint32_t vertex) {
  star_.resize(filling_.size());
  for (std::size_t k = 0; k < filling_.size(); ++k) {
    const std::uint32_t t = star_[k] = place_for(k);
    const Side& side = rim_[k];
    mesh_.triangles[t] = filling_[k];
    mesh_.neighbours[t] = {kNoTriangle, kNoTriangle, side.outer};
    mesh_.constrained[t] = static_cast<std::uint8_t>(side.bits << 2);
    if (side.outer != kNoTriangle) mesh_.neighbours[side.outer][edge_between(side.outer, side.from, side.to)] = t;
    proved_[t] = 0;
    changed_.push_back(t);
    some_triangle_[side.to] = t;
  }
  for (const std::uint32_t t : star_) some_triangle_[mesh_.triangles[t][0]] = t;
  for (const std::uint32_t t : star_) {
    const std::uint32_t next =
        some_triangle_[mesh_.triangles[t][1]];  // it begins where this one ends, unless at a hull
    if (next == t) continue;
    mesh_.neighbours[t][0] = next;
    mesh_.neighbours[next][1] = t;
  }
  for (const Side& half : halves_) {
    for (const std::uint32_t t : star_) {
      const Corners& corners = mesh_.triangles[t];
      if (half.from == corners[1] && half.to == vertex) mesh_.constrained[t] |= half.bits;
      if (half.from == vertex && half.to == corners[0])
        mesh_.constrained[t] |= static_cast<std::uint8_t>(half.bits << 1);
    }
  }
  some_triangle_[vertex] = last_ = star_.front();
}

/// Replaces the triangles of cavity_ by those of filling_, which are no fewer.
void GrowingMesh::replace() {
  std::sort(rim_.begin(), rim_.end(), kByEnds);
  half_edges_.clear();
  for (std::size_t k = 0; k < filling_.size(); ++k) {
    const std::uint32_t t = place_for(k);
    mesh_.triangles[t] = filling_[k];
    mesh_.constrained[t] = 0;
    proved_[t] = 0;
    changed_.push_back(t);
    for (int i = 0; i < 3; ++i) {
      some_triangle_[corner(t, i)] = t;
      half_edges_.push_back({corner(t, i + 1), corner(t, i + 2), t, i});
    }
  }
  std::sort(half_edges_.begin(), half_edges_.end(), kByEnds);
  for (const auto& [from, to, t, i] : half_edges_) {
    const HalfEdge* twin = find(half_edges_, to, from);
    const Side* known = find(rim_, from, to);
    const std::uint32_t other = twin != nullptr ? twin->triangle : known != nullptr ? known->outer : kNoTriangle;
    mesh_.neighbours[t][i] = other;
    if (known != nullptr) mesh_.constrained[t] |= static_cast<std::uint8_t>(known->bits << i);
    if (twin == nullptr && other != kNoTriangle) mesh_.neighbours[other][edge_between(other, from, to)] = t;
  }
  last_ = half_edges_.front().triangle;
}

std::uint32_t GrowingMesh::place_for(std::size_t number) {
  if (number < cavity_.size()) return cavity_[number];
  mesh_.triangles.emplace_back();
  mesh_.neighbours.emplace_back();
  mesh_.constrained.push_back(0);
  proved_.push_back(0);
  return static_cast<std::uint32_t>(mesh_.triangles.size() - 1);
}

/// Calls visit(triangle, corner) for the triangles about a vertex, which is that corner of each, until a call returns
/// true; returns whether one did.
template <class Visit>
bool GrowingMesh::visit_around(std::uint32_t vertex, const Visit& visit) const {
  const std::uint32_t start = some_triangle_[vertex];
  for (const int step : {1, 2}) {  // counterclockwise, and then clockwise if the hull ended that
    std::uint32_t t = start;
    do {
      int i = 0;
      while (corner(t, i) != vertex) ++i;
      if (visit(t, i)) return true;
      t = mesh_.neighbours[t][(i + step) % 3];
    } while (t != kNoTriangle && t != start);
    if (t == start) return false;
  }
  return false;
}

/// Returns the edge that leaves vertex `at` straight towards vertex `to`. Where there is none, to == at, and `left` is
/// the triangle through whose opposite edge the way leads.
SegmentEdge GrowingMesh::edge_towards(std::uint32_t at, std::uint32_t to) const {
  const Position p = position(at), goal = position(to);
  SegmentEdge edge{};
  const bool found = visit_around(at, [&](std::uint32_t t, int i) {
    const std::uint32_t right = corner(t, i + 1), left = corner(t, i + 2);
    const int right_side = orientation(p, goal, position(right)), left_side = orientation(p, goal, position(left));
    if (right_side == 0 && lies_ahead(p, goal, position(right))) {
      edge = {at, right, t, mesh_.neighbours[t][(i + 2) % 3]};
    } else if (left_side == 0 && lies_ahead(p, goal, position(left))) {
      edge = {at, left, mesh_.neighbours[t][(i + 1) % 3], t};
    } else if (right_side < 0 && left_side > 0) {
      edge = {at, at, t, kNoTriangle};
    } else {
      return false;
    }
    return true;
  });
  if (!found) throw Error("a constraint leads out of the triangulation");
  return edge;
}

bool GrowingMesh::has_edge(std::uint32_t from, std::uint32_t to) const {
  return visit_around(from, [&](std::uint32_t t, int i) { return corner(t, i + 1) == to || corner(t, i + 2) == to; });
}

void GrowingMesh::lay(std::uint32_t from, std::uint32_t to, std::uint16_t theme) {
  ITIN_PRECONDITION(some_triangle_.at(from) != kNoTriangle && some_triangle_.at(to) != kNoTriangle);
  const auto mark = [&](std::uint32_t t, const SegmentEdge& edge) {
    if (t == kNoTriangle) return;
    const int line = theme == kCoverage ? kLine | kOutline : kLine;
    mesh_.constrained[t] |= static_cast<std::uint8_t>(line << edge_between(t, edge.from, edge.to));
  };
  for (std::uint32_t at = from; at != to;) {
    SegmentEdge edge = edge_towards(at, to);
    if (edge.to == at) {
      cut(at, to, edge.left);
      edge = edge_towards(at, to);
    }
    mark(edge.left, edge);
    mark(edge.right, edge);
    at = edge.to;
  }
}

void GrowingMesh::edges_of(std::uint32_t from, std::uint32_t to, std::uint16_t theme,
                           std::vector<SegmentEdge>& edges) const {
  for (std::uint32_t at = from; at != to; at = edges.back().to) {
    edges.push_back(edge_towards(at, to));
    edges.back().theme = theme;
    if (edges.back().to == at) throw Error("a constraint is lost in the triangulation");
  }
}

/// Makes an edge from vertex `at` straight towards `to`, up to the first vertex there. The way leaves by triangle t.
void GrowingMesh::cut(std::uint32_t at, std::uint32_t to, std::uint32_t t) {
  clear();
  left_.clear();
  right_.clear();
  int i = 0;  // the edge that is crossed, from right to left
  while (corner(t, i) != at) ++i;
  take(t);
  for (const int beside : {1, 2}) rim_.push_back(side(t, (i + beside) % 3));
  right_.push_back(corner(t, i + 1));
  left_.push_back(corner(t, i + 2));
  std::uint32_t end = at;
  while (end == at) {
    if (bits(t, i) != 0) throw Error("two constraint lines cross; run itin check on the store");
    const std::uint32_t next = mesh_.neighbours[t][i];
    const int j = edge_between(next, right_.back(), left_.back());
    take(next);
    const std::uint32_t apex = corner(next, j);
    const int where = orientation(position(at), position(to), position(apex));
    if (where >= 0) rim_.push_back(side(next, (j + 2) % 3));
    if (where <= 0) rim_.push_back(side(next, (j + 1) % 3));
    if (where > 0) left_.push_back(apex);
    if (where < 0) right_.push_back(apex);
    if (where == 0) end = apex;
    t = next;
    i = (j + (where > 0 ? 1 : 2)) % 3;
  }
  fill_between(at, end, left_);
  std::reverse(right_.begin(), right_.end());
  fill_between(end, at, right_);
  replace();
}

/// Triangulates the polygon to the left of an edge, between it and a chain of vertices, which may turn back on itself.
void GrowingMesh::fill_between(std::uint32_t from, std::uint32_t to, std::span<const std::uint32_t> chain) {
  if (chain.empty()) return;
  std::size_t best = 0;
  for (std::size_t k = 1; k < chain.size(); ++k) {
    if (chain[k] != chain[best] &&
        in_circle_perturbed(position(from), position(to), position(chain[best]), position(chain[k])) > 0)
      best = k;
  }
  filling_.push_back({from, to, chain[best]});
  fill_between(from, chain[best], chain.first(best));
  fill_between(chain[best], to, chain.subspan(best + 1));
}

}  // namespace itin
