#include "features/ground_border.hpp"

#include <algorithm>
#include <set>

#include "features/planarity.hpp"

namespace itin {

namespace {

/// Every edge once, with the range of those that share it.
struct DistinctEdges {
  std::vector<GridEdge> edges;
  std::vector<std::size_t> first;  ///< in the lines' edges, which are ascending; and one behind the last
};

DistinctEdges distinct(const PlanarLines& lines) {
  DistinctEdges result;
  const auto position = [&](std::uint32_t v) { return Position{lines.vertices[v].x, lines.vertices[v].y}; };
  for (std::size_t i = 0; i < lines.edges.size(); ++i) {
    const PlanarEdge& e = lines.edges[i];
    if (i > 0 && lines.edges[i - 1].from == e.from && lines.edges[i - 1].to == e.to) continue;
    result.edges.emplace_back(position(e.from), position(e.to));
    result.first.push_back(i);
  }
  result.first.push_back(lines.edges.size());
  return result;
}

}  // namespace

std::vector<PlacedBorder> place_borders(std::vector<BorderEdge> borders, const PlanarLines& lines,
                                        const std::vector<bool>& terrain) {
  std::sort(borders.begin(), borders.end(), [](const BorderEdge& a, const BorderEdge& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.theme < b.theme;
  });
  borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  if (borders.empty()) return {};
  DistinctEdges all = distinct(lines);
  const std::size_t of_lines = all.edges.size();
  std::vector<std::size_t> first_border;  // of each edge behind those of the lines
  for (std::size_t i = 0; i < borders.size(); ++i) {
    if (i > 0 && borders[i - 1].edge == borders[i].edge) continue;
    all.edges.push_back(borders[i].edge);
    first_border.push_back(i);
  }
  first_border.push_back(borders.size());
  std::vector<std::set<std::uint32_t>> crossed(borders.size());
  for (const auto& [line, edge] : conflicts(all.edges)) {
    if (line >= of_lines || edge < of_lines) continue;
    const std::size_t k = edge - of_lines;
    for (std::size_t b = first_border[k]; b < first_border[k + 1]; ++b)
      for (std::size_t i = all.first[line]; i < all.first[line + 1]; ++i) crossed[b].insert(lines.edges[i].owner);
  }
  std::vector<PlacedBorder> placed;
  for (std::size_t b = 0; b < borders.size(); ++b) {
    const bool needless = std::any_of(crossed[b].begin(), crossed[b].end(), [&](std::uint32_t owner) {
      return owner == borders[b].theme || (owner < terrain.size() && terrain[owner]);
    });
    if (!needless) placed.push_back({borders[b], {crossed[b].begin(), crossed[b].end()}});
  }
  return placed;
}

}  // namespace itin
