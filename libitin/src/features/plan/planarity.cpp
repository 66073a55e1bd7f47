#include "features/plan/planarity.hpp"

#include <algorithm>
#include <map>

#include <itin/sort_unique.hpp>

#include "base/stoppable.hpp"
#include "features/plan/hot_pixel.hpp"
#include "store/segments/edge_quadtree.hpp"
#include "triangulate/apex/apex.hpp"

namespace itin {

namespace {

/// Tells whether two different edges, each with its lesser end first, conflict.
bool in_conflict(const GridEdge& s, const GridEdge& t) {
  const int tc = orientation(s.first, s.second, t.first), td = orientation(s.first, s.second, t.second);
  const int sa = orientation(t.first, t.second, s.first), sb = orientation(t.first, t.second, s.second);
  if (tc * td < 0 && sa * sb < 0) return true;
  const auto within = [](const GridEdge& e, Position p) {
    return p != e.first && p != e.second && on_segment(e.first, e.second, p);
  };
  return within(s, t.first) || within(s, t.second) || within(t, s.first) || within(t, s.second);
}

std::int64_t floored_quotient(Int128 numerator, Int128 denominator) {
  if (denominator < 0) numerator = -numerator, denominator = -denominator;
  const Int128 quotient = numerator / denominator;
  return static_cast<std::int64_t>(quotient - (numerator % denominator < 0));
}

/// The Morton code of the grid square in which two edges cross. The square lies in one cell of the quadtree, which both
/// edges meet.
std::uint64_t crossing_square(const Segment& s, const Segment& t) {
  const Position a = s.a(), b = s.b(), c = t.a(), d = t.b();
  const Int128 from = doubled_area(c, d, a), whole = from - doubled_area(c, d, b);
  const auto along = [&](std::int32_t start, std::int32_t end) {
    return static_cast<std::int32_t>(start + floored_quotient(from * (std::int64_t{end} - start), whole));
  };
  return morton(along(a.x, b.x), along(a.y, b.y));
}

/// The places within a cell where two different edges meet other than at ends of both.
std::uint64_t meetings(const Cell& cell, const Segment& s, const Segment& t) {
  if (std::min(t.ay, t.by) > std::max(s.ay, s.by) || std::max(t.ay, t.by) < std::min(s.ay, s.by)) return 0;
  const Position a = s.a(), b = s.b(), c = t.a(), d = t.b();
  if (crosses(s, c, d)) return cell.contains(crossing_square(s, t)) ? 1 : 0;
  const auto within = [&](Position from, Position to, Position p) {
    return p != from && p != to && on_segment(from, to, p) && cell.contains(code_of(p)) ? 1 : 0;
  };
  return static_cast<std::uint64_t>(within(a, b, c) + within(a, b, d) + within(c, d, a) + within(c, d, b));
}

}  // namespace

void visit_conflicts(std::span<const GridEdge> edges, const std::function<bool(std::uint32_t, std::uint32_t)>& visit) {
  std::vector<std::pair<GridEdge, std::uint32_t>> numbers;
  std::vector<Segment> segments;
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const auto [a, b] = std::minmax(edges[i].first, edges[i].second);
    if (a == b) continue;
    numbers.push_back({{a, b}, i});
    segments.push_back({a.x, a.y, b.x, b.y});
  }
  std::sort(numbers.begin(), numbers.end());
  const auto number = [&](const Segment& s) {
    const GridEdge edge{s.a(), s.b()};
    return std::lower_bound(numbers.begin(), numbers.end(), std::pair{edge, std::uint32_t{0}})->second;
  };
  visit_edge_leaves(std::move(segments), [&](const Cell& cell, const std::vector<Segment>& near) {
    stop_if_asked();
    for (std::size_t i = 0; i < near.size(); ++i) {
      for (std::size_t j = i + 1; j < near.size() && near[j].ax <= near[i].bx; ++j)
        for (std::uint64_t k = meetings(cell, near[i], near[j]); k > 0; --k)
          if (!visit(number(near[i]), number(near[j]))) return false;
    }
    return true;
  });
}

std::uint64_t count_conflicts(std::span<const GridEdge> edges, std::uint64_t most) {
  std::uint64_t found = 0;
  visit_conflicts(edges, [&](std::uint32_t, std::uint32_t) { return ++found <= most; });
  return found;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> conflicts(std::span<const GridEdge> edges) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  std::map<GridEdge, std::uint32_t> number;
  std::vector<Segment> segments;
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const auto [a, b] = std::minmax(edges[i].first, edges[i].second);
    stop_if_asked();
    const auto [first, inserted] = number.insert({{a, b}, i});
    if (inserted) segments.push_back({a.x, a.y, b.x, b.y});
    if (!inserted) found.emplace_back(first->second, i);
  }
  for_each_edge_leaf(std::move(segments), [&](const Cell&, const std::vector<Segment>& near) {
    stop_if_asked();
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
  sort_unique(found);
  return found;
}

}  // namespace itin
