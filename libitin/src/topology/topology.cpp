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
  std::vector<std::uint32_t> outgoing;
  group_by_origin(outgoing);
  order_stars(outgoing);
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
  neighbours_.reserve(twins_.size() + boundary);
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
        neighbours_.push_back(destination(h));
        const std::uint32_t last = previous(h);
        h = twins_[last];
        if (h == kNoNeighbour) neighbours_.push_back(origin(last));
      } while (h != kNoNeighbour && h != *fan);
    }
    first_neighbour_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
  }
}

}  // namespace itin
