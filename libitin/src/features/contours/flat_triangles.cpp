#include "features/contours/flat_triangles.hpp"

#include <algorithm>

#include "geometry/cell.hpp"

namespace itin {

namespace {

std::array<GridPoint, 3> corners_of(const LevelEdge& e) {
  std::array<GridPoint, 3> corners{e.a, e.b, e.opposite};
  std::sort(corners.begin(), corners.end(), before_by_code);
  return corners;
}

bool same_edge(const LevelEdge& d, const LevelEdge& e) {
  return code_of(d.a) == code_of(e.a) && code_of(d.b) == code_of(e.b);
}

}  // namespace

FlatTriangles::FlatTriangles(std::vector<LevelEdge> edges) {
  const auto key = [](const LevelEdge& e) { return std::array{code_of(e.a), code_of(e.b), code_of(e.opposite)}; };
  std::sort(edges.begin(), edges.end(), [&](const LevelEdge& d, const LevelEdge& e) { return key(d) < key(e); });
  find_triangles(edges);
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first + 1;
    while (last < edges.size() && same_edge(edges[first], edges[last])) ++last;
    join(std::span(edges).subspan(first, last - first));
    first = last;
  }
  find_regions();
}

void FlatTriangles::find_triangles(const std::vector<LevelEdge>& edges) {
  for (const LevelEdge& e : edges) {
    const std::array<GridPoint, 3> corners = corners_of(e);
    // Each triangle is added once: with the edge opposite its last corner.
    if (e.flat && code_of(corners[2]) == code_of(e.opposite)) triangles_.push_back({corners, {}});
  }
  std::sort(triangles_.begin(), triangles_.end(), [](const Triangle& s, const Triangle& t) {
    return std::lexicographical_compare(s.corners.begin(), s.corners.end(), t.corners.begin(), t.corners.end(),
                                        before_by_code);
  });
}

std::uint32_t FlatTriangles::number_of(const LevelEdge& edge) const {
  const std::array<GridPoint, 3> corners = corners_of(edge);
  const auto found =
      std::lower_bound(triangles_.begin(), triangles_.end(), corners, [](const Triangle& t, const auto& c) {
        return std::lexicographical_compare(t.corners.begin(), t.corners.end(), c.begin(), c.end(), before_by_code);
      });
  return static_cast<std::uint32_t>(found - triangles_.begin());
}

/// Tells the flat triangles at an edge what is beyond it.
void FlatTriangles::join(std::span<const LevelEdge> at_edge) {
  for (std::size_t i = 0; i < at_edge.size(); ++i) {
    if (!at_edge[i].flat) continue;
    Triangle& triangle = triangles_[number_of(at_edge[i])];
    std::size_t slot = 0;
    while (code_of(triangle.corners[slot]) != code_of(at_edge[i].opposite)) ++slot;
    Side& side = triangle.sides[slot];
    if (at_edge.size() != 2) continue;
    const LevelEdge& other = at_edge[1 - i];
    side.ground_beyond = true;
    side.beyond = other.opposite;
    side.contour_beyond = other.opposite_on_contour;
    if (at_edge[i].constrained) continue;
    side.passage = other.flat ? Passage::kFlat : Passage::kExit;
    if (other.flat) side.triangle = number_of(other);
  }
}

void FlatTriangles::find_regions() {
  std::vector<bool> seen(triangles_.size(), false);
  for (std::uint32_t first = 0; first < triangles_.size(); ++first) {
    if (seen[first]) continue;
    Region region{first};
    seen[first] = true;
    for (std::size_t at = 0; at < region.size(); ++at) {
      for (const Side& side : triangles_[region[at]].sides) {
        if (side.triangle == kNoTriangle || seen[side.triangle]) continue;
        seen[side.triangle] = true;
        region.push_back(side.triangle);
      }
    }
    std::sort(region.begin(), region.end());
    regions_.push_back(std::move(region));
  }
}

}  // namespace itin
