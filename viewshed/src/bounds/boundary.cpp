#include "bounds/boundary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include <itin/parallel.hpp>
#include <itin/precondition.hpp>
#include <itin/segment_distance.hpp>

#include "line/hulls.hpp"

namespace itin::viewshed {

namespace {

constexpr std::size_t kFansPerChunk = 1 << 12;

/// The triangles by the lesser end of the side opposite their least corner. Sides at the least corner need no list,
/// since triangles come in the order of that corner.
class OppositeSides {
 public:
  explicit OppositeSides(const Tin& tin) : first_(tin.vertices.size() + 1), triangles_(tin.triangles.size()) {
    const auto lesser_end = [](const Triangle& t) { return std::min(t[1], t[2]); };
    for (const Triangle& t : tin.triangles) ++first_[lesser_end(t)];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    for (std::size_t t = tin.triangles.size(); t-- > 0;)
      triangles_[--first_[lesser_end(tin.triangles[t])]] = static_cast<std::uint32_t>(t);
  }

  std::span<const std::uint32_t> from(std::uint32_t vertex) const {
    return std::span(triangles_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
  }

 private:
  std::vector<std::uint32_t> first_;  ///< vertex v has triangles_[first_[v], first_[v + 1])
  std::vector<std::uint32_t> triangles_;
};

/// A side of a triangle from a vertex.
struct Side {
  std::uint32_t other_end;
  std::size_t half_edge;  ///< 3 t + i: from corner i of triangle t
};

/// Adds the sides at a vertex that no other triangle has. Orders `sides`.
void add_unpaired(std::vector<Side>& sides, std::vector<std::size_t>& unpaired) {
  std::ranges::sort(sides, {}, &Side::other_end);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool paired = i + 1 < sides.size() && sides[i].other_end == sides[i + 1].other_end;
    if (!paired) unpaired.push_back(sides[i].half_edge);
    if (paired) ++i;
  }
}

Point2 in_units(const Grid& units, Point2 p) {
  return {(p.x - units.origin.x) / units.resolution, (p.y - units.origin.y) / units.resolution};
}

/// Tells whether the hull reaches the segment. Precondition: a place of the hull lies to the right of a -> b.
bool meets_segment(const std::vector<Point2>& hull, Point2 a, Point2 b) {
  ITIN_PRECONDITION(std::any_of(hull.begin(), hull.end(), [&](Point2 p) { return left_of(a, b, p) < 0; }));
  const bool crosses_straight = std::any_of(hull.begin(), hull.end(), [&](Point2 p) { return left_of(a, b, p) >= 0; });
  return crosses_straight && !beyond_a_side(hull, std::array{a, b});
}

}  // namespace

std::vector<BoundaryEdge> boundary_edges(const Tin& tin) {
  const OppositeSides opposite(tin);
  std::vector<std::vector<std::size_t>> alone((tin.vertices.size() + kFansPerChunk - 1) / kFansPerChunk);
  parallel_for(alone.size(), [&](std::size_t chunk) {
    const auto begin = static_cast<std::uint32_t>(chunk * kFansPerChunk);
    const auto end = static_cast<std::uint32_t>(std::min(tin.vertices.size(), (chunk + 1) * kFansPerChunk));
    auto t = static_cast<std::size_t>(
        std::ranges::lower_bound(tin.triangles, begin, {}, [](const Triangle& of) { return of[0]; }) -
        tin.triangles.begin());
    std::vector<Side> sides;
    for (std::uint32_t vertex = begin; vertex < end; ++vertex) {
      sides.clear();
      for (; t < tin.triangles.size() && tin.triangles[t][0] == vertex; ++t) {
        sides.push_back({tin.triangles[t][1], 3 * t});
        sides.push_back({tin.triangles[t][2], 3 * t + 2});
      }
      for (const std::uint32_t of : opposite.from(vertex)) {
        const auto& [least, b, c] = tin.triangles[of];
        sides.push_back({std::max(b, c), std::size_t{3} * of + 1});
      }
      add_unpaired(sides, alone[chunk]);
    }
  });
  std::vector<std::size_t> half_edges;
  for (const auto& of_chunk : alone) half_edges.insert(half_edges.end(), of_chunk.begin(), of_chunk.end());
  std::sort(half_edges.begin(), half_edges.end());
  std::vector<BoundaryEdge> edges;
  edges.reserve(half_edges.size());
  for (const std::size_t h : half_edges) {
    const Triangle& t = tin.triangles[h / 3];
    edges.push_back({t[h % 3], t[(h + 1) % 3], static_cast<std::uint32_t>(h / 3)});
  }
  return edges;
}

std::vector<RimEdge> rim_of(const Tin& tin, const std::vector<BoundaryEdge>& boundary) {
  std::vector<RimEdge> rim;
  rim.reserve(boundary.size());
  const auto place = [&](std::uint32_t vertex) { return GridPlace{tin.vertices[vertex].x, tin.vertices[vertex].y}; };
  for (const BoundaryEdge& edge : boundary) rim.push_back({place(edge.from), place(edge.to)});
  return rim;
}

bool surface_resumes(const Grid& units, const std::vector<RimEdge>& rim, Point2 position, double reach,
                     const std::vector<Point2>& lines) {
  const Point2 p = in_units(units, position);
  std::vector<Point2> hull;
  for (const Point2& corner : lines) hull.push_back(in_units(units, corner));
  return std::any_of(rim.begin(), rim.end(), [&](const RimEdge& edge) {
    const auto& [from, to] = edge;
    const Point2 a{static_cast<double>(from.x), static_cast<double>(from.y)};
    const Point2 b{static_cast<double>(to.x), static_cast<double>(to.y)};
    const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    // A millionth of a grid unit is allowed, so that a position on the boundary's own line does not count.
    const bool outside = side < -1e-6 * std::hypot(b.x - a.x, b.y - a.y);
    return outside && distance_to_segment(p, a, b) * units.resolution < reach && meets_segment(hull, a, b);
  });
}

}  // namespace itin::viewshed
