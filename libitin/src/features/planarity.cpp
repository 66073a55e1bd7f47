#include "features/planarity.hpp"

#include <algorithm>
#include <map>

#include "features/hot_pixel.hpp"
#include "store/edge_quadtree.hpp"

namespace itin {

namespace {

/// Two different edges, each with its lesser end first.
bool in_conflict(const GridEdge& s, const GridEdge& t) {
  const int tc = orientation(s.first, s.second, t.first), td = orientation(s.first, s.second, t.second);
  const int sa = orientation(t.first, t.second, s.first), sb = orientation(t.first, t.second, s.second);
  if (tc * td < 0 && sa * sb < 0) return true;
  const auto within = [](const GridEdge& e, Position p) {
    return p != e.first && p != e.second && on_segment(e.first, e.second, p);
  };
  return within(s, t.first) || within(s, t.second) || within(t, s.first) || within(t, s.second);
}

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> conflicts(std::span<const GridEdge> edges) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  std::map<GridEdge, std::uint32_t> number;
  std::vector<Segment> segments;
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const auto [a, b] = std::minmax(edges[i].first, edges[i].second);
    const auto [first, inserted] = number.insert({{a, b}, i});
    if (inserted) segments.push_back({a.x, a.y, b.x, b.y});
    if (!inserted) found.emplace_back(first->second, i);
  }
  for_each_edge_leaf(std::move(segments), [&](const Cell&, const std::vector<Segment>& near) {
    for (std::size_t i = 0; i < near.size(); ++i) {
      for (std::size_t j = i + 1; j < near.size() && near[j].ax <= near[i].bx; ++j) {
        const GridEdge s{{near[i].ax, near[i].ay}, {near[i].bx, near[i].by}};
        const GridEdge t{{near[j].ax, near[j].ay}, {near[j].bx, near[j].by}};
        if (!in_conflict(s, t)) continue;
        const auto [least, greatest] = std::minmax(number.at(s), number.at(t));
        found.emplace_back(least, greatest);
      }
    }
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace itin
