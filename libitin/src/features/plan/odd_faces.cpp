#include "features/plan/odd_faces.hpp"

#include <map>
#include <optional>
#include <queue>

#include "features/plan/planar.hpp"

namespace itin {

namespace {

/// The pieces of the ring that it runs along an odd number of times: one side of each is inside.
std::vector<GridEdge> odd_edges(const GridRing& ring) {
  std::vector<OwnedSegment> segments;
  for_each_edge(GridPolygon{ring, {}}, [&](Position a, Position b) {
    segments.push_back({{a.x, a.y, 0}, {b.x, b.y, 0}, static_cast<std::uint32_t>(segments.size())});
  });
  const PlanarLines lines = make_planar(std::move(segments));
  std::vector<GridEdge> edges;
  for (auto e = lines.edges.begin(); e != lines.edges.end();) {
    const auto end = std::find_if(e, lines.edges.end(),
                                  [&](const PlanarEdge& other) { return other.from != e->from || other.to != e->to; });
    const GridPoint &a = lines.vertices[e->from], &b = lines.vertices[e->to];
    if ((end - e) % 2 != 0) edges.emplace_back(Position{a.x, a.y}, Position{b.x, b.y});
    e = end;
  }
  return edges;
}

}  // namespace

GridPolygons odd_faces(const GridRing& ring) {
  std::vector<PlanFace> faces = faces_of(odd_edges(ring));
  std::map<GridEdge, std::size_t> left_of;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for_each_edge(faces[f].polygon, [&](Position a, Position b) { left_of[{a, b}] = f; });
  // Inside and outside take turns at every edge, beginning outside of all faces.
  std::vector<std::optional<bool>> odd(faces.size());
  std::queue<std::size_t> reached;
  const auto reach = [&](std::size_t f, bool is_odd) {
    if (odd[f]) return;
    odd[f] = is_odd;
    reached.push(f);
  };
  for (const auto& [edge, f] : left_of)
    if (!left_of.contains({edge.second, edge.first})) reach(f, true);
  for (; !reached.empty(); reached.pop()) {
    const std::size_t f = reached.front();
    for_each_edge(faces[f].polygon, [&](Position a, Position b) {
      const auto beyond = left_of.find({b, a});
      if (beyond != left_of.end()) reach(beyond->second, !*odd[f]);
    });
  }
  GridPolygons result;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (odd[f].value_or(false)) result.push_back(std::move(faces[f].polygon));
  return result;
}

}  // namespace itin
