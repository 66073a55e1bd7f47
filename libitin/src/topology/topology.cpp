#include <algorithm>

#include <itin/topology.hpp>

#include "geometry/predicates.hpp"
#include "topology/twin_half_edges.hpp"

namespace itin {

namespace {

/// The counterclockwise order of the directions from `centre`, beginning with the direction of `start`.
class Around {
 public:
  Around(const GridPoint& centre, const GridPoint& start) : centre_(centre), start_(start) {}
  bool operator()(const GridPoint& p, const GridPoint& q) const {
    const bool p_behind = behind(p), q_behind = behind(q);
    return p_behind != q_behind ? q_behind : side_of(p, q) > 0;
  }

 private:
  std::int64_t side_of(const GridPoint& p, const GridPoint& q) const { return doubled_area(centre_, p, q); }
  std::int64_t along(const GridPoint& p) const {
    return std::int64_t{p.x - centre_.x} * (start_.x - centre_.x) +
           std::int64_t{p.y - centre_.y} * (start_.y - centre_.y);
  }
  /// Tells whether p is half a turn or more from the start.
  bool behind(const GridPoint& p) const {
    const std::int64_t side = side_of(start_, p);
    return side < 0 || (side == 0 && along(p) < 0);
  }

  GridPoint centre_, start_;
};

}  // namespace

Topology::Topology(const Tin& tin) : tin_(&tin), twins_(twin_half_edges(tin)) {
  number_edges();
  std::vector<std::uint32_t> outgoing;
  group_by_origin(outgoing);
  order_stars(outgoing);
}

void Topology::number_edges() {
  edge_of_half_edge_.resize(twins_.size());
  half_edge_of_edge_.reserve(twins_.size() / 2 + twins_.size() / 16);
  for (std::uint32_t h = 0; h < twins_.size(); ++h) {
    if (twins_[h] < h) {
      edge_of_half_edge_[h] = edge_of_half_edge_[twins_[h]];
    } else {
      edge_of_half_edge_[h] = edge_count();
      half_edge_of_edge_.push_back(h);
    }
  }
}

/// Fills first_triangle_, and `outgoing` with each vertex's half-edges in ascending order.
void Topology::group_by_origin(std::vector<std::uint32_t>& outgoing) {
  first_triangle_.assign(tin_->vertices.size() + 1, 0);
  for (const Triangle& t : tin_->triangles) {
    for (const std::uint32_t v : t) ++first_triangle_[v + 1];
  }
  for (std::size_t v = 0; v < tin_->vertices.size(); ++v) first_triangle_[v + 1] += first_triangle_[v];
  outgoing.resize(twins_.size());
  std::vector<std::uint32_t> end(first_triangle_.begin(), first_triangle_.end() - 1);
  for (std::uint32_t h = 0; h < twins_.size(); ++h) outgoing[end[origin(h)]++] = h;
}

/// Walks the fans of every vertex.
void Topology::order_stars(std::vector<std::uint32_t>& outgoing) {
  const auto boundary =
      static_cast<std::size_t>(std::count(twins_.begin(), twins_.end(), kNoNeighbour));  // one fan begins at each
  triangles_.reserve(twins_.size());
  neighbours_.reserve(twins_.size() + boundary);
  edges_.reserve(twins_.size() + boundary);
  first_neighbour_.assign(1, 0);
  first_neighbour_.reserve(tin_->vertices.size() + 1);

  const auto at_end = [this](std::uint32_t h) -> const GridPoint& { return tin_->vertices[destination(h)]; };
  for (std::uint32_t v = 0; v < vertex_count(); ++v) {
    const auto begin = outgoing.begin() + first_triangle_[v], end = outgoing.begin() + first_triangle_[v + 1];
    auto fans_end = std::partition(begin, end, [this](std::uint32_t h) { return twins_[h] == kNoNeighbour; });
    if (fans_end == begin && begin != end) ++fans_end;  // enclosed: it may begin anywhere, and begins with the least
    if (fans_end - begin > 1) {
      std::iter_swap(begin, std::min_element(begin, fans_end));
      const Around around(tin_->vertices[v], at_end(*begin));
      std::sort(begin + 1, fans_end, [&](std::uint32_t g, std::uint32_t h) { return around(at_end(g), at_end(h)); });
    }
    for (auto fan = begin; fan != fans_end; ++fan) {
      std::uint32_t h = *fan;
      do {
        triangles_.push_back(face(h));
        neighbours_.push_back(destination(h));
        edges_.push_back(edge(h));
        const std::uint32_t last = previous(h);
        h = twins_[last];
        if (h == kNoNeighbour) {
          neighbours_.push_back(origin(last));
          edges_.push_back(edge(last));
        }
      } while (h != kNoNeighbour && h != *fan);
    }
    first_neighbour_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
  }
}

void Topology::edges_of_edge(std::uint32_t e, std::vector<std::uint32_t>& out) const {
  for (const std::uint32_t v : vertices_of_edge(e)) {
    const auto around = edges_of_vertex(v);
    const auto self = std::find(around.begin(), around.end(), e);
    out.insert(out.end(), self + 1, around.end());
    out.insert(out.end(), around.begin(), self);
  }
}

std::array<std::optional<std::uint32_t>, 2> Topology::triangles_of_edge(std::uint32_t e) const {
  const std::uint32_t h = half_edge(e);
  const auto other = twin(h);
  return {face(h), other ? std::optional(face(*other)) : std::nullopt};
}

std::array<std::optional<std::uint32_t>, 3> Topology::triangles_of_triangle(std::uint32_t t) const {
  std::array<std::optional<std::uint32_t>, 3> adjacent;
  for (std::uint32_t i = 0; i < 3; ++i) {
    if (const auto other = twin(3 * t + i)) adjacent[i] = face(*other);
  }
  return adjacent;
}

}  // namespace itin
