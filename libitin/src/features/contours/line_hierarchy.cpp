#include "features/contours/line_hierarchy.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include <itin/box_of.hpp>
#include <itin/sort_unique.hpp>

#include "features/plan/hot_pixel.hpp"
#include "geometry/morton_range.hpp"
#include "triangulate/apex/apex.hpp"

namespace itin {

namespace {

GridBox box_of_piece(std::span<const Position> vertices, std::size_t from, std::size_t to) {
  return box_of(vertices.subspan(from, to - from + 1));
}

/// Whether p lies in the closed polygon, a simple one, of the chain's piece and its shortcut.
bool in_pocket(const std::vector<Position>& vertices, std::size_t from, std::size_t to, Position p) {
  bool inside = false;
  for (std::size_t i = from; i <= to; ++i) {
    const Position a = vertices[i], b = i == to ? vertices[from] : vertices[i + 1];
    if (on_segment(a, b, p)) return true;
    if ((a.y > p.y) != (b.y > p.y)) inside ^= (orientation(a, b, p) > 0) == (b.y > a.y);
  }
  return inside;
}

Segment plan_between(Position p, Position q, std::uint16_t theme) {
  const auto [a, b] = std::minmax({p, q});
  return {a.x, a.y, b.x, b.y, theme};
}

/// How far a vertex is from a shortcut, as a share of the tolerance.
double misfit(Position a, std::int32_t za, Position b, std::int32_t zb, Position p, std::int32_t z,
              const LineTolerance& tolerance) {
  const double dx = static_cast<double>(b.x) - a.x, dy = static_cast<double>(b.y) - a.y;
  const double px = static_cast<double>(p.x) - a.x, py = static_cast<double>(p.y) - a.y;
  const double t = std::clamp((px * dx + py * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  const double lateral = std::hypot(px - t * dx, py - t * dy);
  const double vertical = std::abs(z - (za + t * (static_cast<double>(zb) - za)));
  return std::max(lateral / tolerance.lateral, vertical / tolerance.vertical);
}

}  // namespace

/// The graph of the lines: which vertices are joined, and by which themes.
class LineHierarchy::Graph {
 public:
  Graph(const std::vector<Segment>& segments, const std::vector<Segment>& whole,
        const std::vector<std::uint64_t>& nodes)
      : nodes_(nodes) {
    std::sort(nodes_.begin(), nodes_.end());
    for (const Segment& s : segments) themes_[ends(s)].push_back(s.theme);
    for (auto& [edge, themes] : themes_) std::sort(themes.begin(), themes.end());
    for (const auto& [edge, themes] : themes_) join(edge);
    std::map<Edge, int> apart;
    for (const Segment& s : whole) apart[ends(s)] = 1;
    for (const auto& [edge, one] : apart) {
      keep_.push_back(edge.first);
      keep_.push_back(edge.second);
    }
    std::sort(keep_.begin(), keep_.end());
  }

  std::vector<Chain> chains() {
    std::vector<Chain> result;
    for (const auto& [vertex, neighbours] : neighbours_) {
      if (!is_node(vertex)) continue;
      for (const std::uint64_t next : neighbours) {
        if (used_.contains(edge(vertex, next))) continue;
        Chain chain = chain_from(vertex, next);
        if (chain.vertices.front() == chain.vertices.back()) {
          cut_ring(chain, false, result);
        } else {
          result.push_back(std::move(chain));
        }
      }
    }
    // Only closed chains without nodes are left.
    for (const auto& [e, themes] : themes_) {
      if (!used_.contains(e)) cut_ring(chain_from(e.first, e.second), true, result);
    }
    return result;
  }

 private:
  using Edge = std::pair<std::uint64_t, std::uint64_t>;

  static Edge edge(std::uint64_t a, std::uint64_t b) { return std::minmax({a, b}); }
  static Edge ends(const Segment& s) { return edge(code_of(s.a()), code_of(s.b())); }

  void join(const Edge& e) {
    neighbours_[e.first].push_back(e.second);
    neighbours_[e.second].push_back(e.first);
  }

  bool is_node(std::uint64_t v) const {
    const std::vector<std::uint64_t>& n = neighbours_.at(v);
    return n.size() != 2 || themes_.at(edge(v, n[0])) != themes_.at(edge(v, n[1])) ||
           std::binary_search(nodes_.begin(), nodes_.end(), v) || std::binary_search(keep_.begin(), keep_.end(), v);
  }

  Chain chain_from(std::uint64_t start, std::uint64_t next) {
    Chain chain;
    chain.themes = themes_.at(edge(start, next));
    chain.vertices.push_back(position_of(start));
    std::uint64_t before = start;
    for (std::uint64_t at = next;;) {
      used_[edge(before, at)] = true;
      chain.vertices.push_back(position_of(at));
      if (at == start || is_node(at)) return chain;
      const std::vector<std::uint64_t>& n = neighbours_.at(at);
      const std::uint64_t onwards = n[0] == before ? n[1] : n[0];
      before = at;
      at = onwards;
    }
  }

  /// Cuts a closed line at its node or, if it may start `anywhere`, at its least vertex; at the vertex farthest from
  /// there; and at the one farthest from the line through both.
  static void cut_ring(const Chain& ring, bool anywhere, std::vector<Chain>& out) {
    std::vector<Position> v(ring.vertices.begin(), ring.vertices.end() - 1);
    if (anywhere) std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    const auto from_first = [&](Position p) {
      const std::int64_t dx = std::int64_t{p.x} - v.front().x, dy = std::int64_t{p.y} - v.front().y;
      return dx * dx + dy * dy;
    };
    const auto last =
        std::max_element(v.begin(), v.end(), [&](Position a, Position b) { return from_first(a) < from_first(b); });
    const auto farthest = std::max_element(v.begin(), v.end(), [&](Position a, Position b) {
      return std::abs(doubled_area(v.front(), *last, a)) < std::abs(doubled_area(v.front(), *last, b));
    });
    std::vector<std::size_t> cuts{0, static_cast<std::size_t>(last - v.begin()),
                                  static_cast<std::size_t>(farthest - v.begin()), v.size()};
    std::sort(cuts.begin(), cuts.end());
    v.push_back(v.front());
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      Chain piece;
      piece.themes = ring.themes;
      piece.vertices.assign(v.begin() + static_cast<std::ptrdiff_t>(cuts[i - 1]),
                            v.begin() + static_cast<std::ptrdiff_t>(cuts[i]) + 1);
      if (piece.vertices.size() > 1) out.push_back(std::move(piece));
    }
  }

  std::vector<std::uint64_t> nodes_, keep_;
  std::map<Edge, std::vector<std::uint16_t>> themes_;
  std::map<std::uint64_t, std::vector<std::uint64_t>> neighbours_;
  std::map<Edge, bool> used_;
};

LineHierarchy::LineHierarchy(const std::vector<Segment>& segments, const std::vector<Segment>& whole,
                             const std::vector<std::uint64_t>& nodes, const HeightAt& height,
                             const std::vector<LineTolerance>& tolerances)
    : coarsest_(static_cast<int>(tolerances.size()) - 1), obstacles_(nodes) {
  for (const std::vector<Segment>* list : {&segments, &whole}) {
    for (const Segment& s : *list) {
      obstacles_.push_back(code_of(s.a()));
      obstacles_.push_back(code_of(s.b()));
    }
  }
  sort_unique(obstacles_);
  chains_ = Graph(segments, whole, nodes).chains();
  for (Chain& chain : chains_) {
    for (const Position p : chain.vertices) chain.heights.push_back(height(p));
    simplify(chain, tolerances);
  }
}

void LineHierarchy::simplify(Chain& chain, const std::vector<LineTolerance>& tolerances) const {
  chain.levels.assign(chain.vertices.size(), 0);
  chain.levels.front() = chain.levels.back() = static_cast<std::uint8_t>(coarsest_);
  for (int k = 1; k <= coarsest_; ++k)
    choose(chain, 0, chain.vertices.size() - 1, k, tolerances[static_cast<std::size_t>(k)]);
}

/// Gives level k to those vertices between `from` and `to`, all of level k - 1, that the line needs there.
void LineHierarchy::choose(Chain& chain, std::size_t from, std::size_t to, int level,
                           const LineTolerance& tolerance) const {
  double worst = -1, worst_candidate = -1;
  std::size_t candidate = from;
  for (std::size_t i = from + 1; i < to; ++i) {
    const double off = misfit(chain.vertices[from], chain.heights[from], chain.vertices[to], chain.heights[to],
                              chain.vertices[i], chain.heights[i], tolerance);
    worst = std::max(worst, off);
    if (chain.levels[i] < level - 1 || off <= worst_candidate) continue;
    worst_candidate = off;
    candidate = i;
  }
  // Between neighbours at the finer level nothing is left to choose.
  if (candidate == from) return;
  if (worst <= 1 && may_replace(chain, from, to)) return;
  chain.levels[candidate] = static_cast<std::uint8_t>(level);
  choose(chain, from, candidate, level, tolerance);
  choose(chain, candidate, to, level, tolerance);
}

bool LineHierarchy::may_replace(const Chain& chain, std::size_t from, std::size_t to) const {
  const std::vector<Position>& v = chain.vertices;
  const Position a = v[from], b = v[to];
  const Segment shortcut{a.x, a.y, b.x, b.y};
  for (std::size_t i = from; i < to; ++i) {
    if (crosses(shortcut, v[i], v[i + 1])) return false;
  }
  std::vector<std::uint64_t> own;
  for (std::size_t i = from; i <= to; ++i) own.push_back(code_of(v[i]));
  std::sort(own.begin(), own.end());
  const GridBox box = box_of_piece(v, from, to);
  const MortonRange range(box);
  for (auto at = obstacles_.begin();;) {
    const std::optional<std::uint64_t> code = range.next(at == obstacles_.end() ? ~std::uint64_t{0} >> 4 : *at);
    if (!code) return true;
    at = std::lower_bound(at, obstacles_.end(), *code);
    if (at == obstacles_.end()) return true;
    const Position p = position_of(*at);
    if (box.contains(p.x, p.y)) {
      if (!std::binary_search(own.begin(), own.end(), *at) && in_pocket(v, from, to, p)) return false;
      if (++at == obstacles_.end()) return true;
    }
  }
}

/// Calls visit(from, to, finest, coarsest, extent) for every edge of every level.
template <class Visit>
void LineHierarchy::for_each_edge(const Chain& chain, const Visit& visit) const {
  struct Edge {
    std::size_t to;
    GridBox extent;
  };
  // The line at the level below, by the edges' starts.
  std::unordered_map<std::size_t, Edge> below;
  for (int k = 0; k <= coarsest_; ++k) {
    std::unordered_map<std::size_t, Edge> line;
    std::size_t from = 0;
    for (std::size_t to = 1; to < chain.vertices.size(); ++to) {
      if (chain.levels[to] < k) continue;
      const bool same = k > 0 && below.at(from).to == to;
      Edge edge{to, box_of(std::array{chain.vertices[from], chain.vertices[to]})};
      if (same) {
        edge = below.at(from);
      } else {
        if (k > 0) {
          for (std::size_t i = from; i < to; i = below.at(i).to) edge.extent.extend(below.at(i).extent);
        }
        const std::uint8_t coarsest = std::min(chain.levels[from], chain.levels[to]);
        visit(from, to, static_cast<std::uint8_t>(k), coarsest == coarsest_ ? std::uint8_t{0xff} : coarsest,
              edge.extent);
      }
      // The extent is widened alike on all sides, so that the edge's piece stays within when the extent is read again.
      const GridBox plain = box_of(std::array{chain.vertices[from], chain.vertices[to]});
      const std::int32_t reach = std::max({plain.xmin - edge.extent.xmin, edge.extent.xmax - plain.xmax,
                                           plain.ymin - edge.extent.ymin, edge.extent.ymax - plain.ymax});
      edge.extent = {plain.xmin - reach, plain.ymin - reach, plain.xmax + reach, plain.ymax + reach};
      line.emplace(from, edge);
      from = to;
    }
    below = std::move(line);
  }
}

/// Calls visit(segment) for every edge of every level and every theme of the chain.
template <class Visit>
void LineHierarchy::for_each_segment(const Chain& chain, const Visit& visit) const {
  for_each_edge(
      chain, [&](std::size_t from, std::size_t to, std::uint8_t finest, std::uint8_t coarsest, const GridBox& extent) {
        const auto [a, b] = std::minmax({chain.vertices[from], chain.vertices[to]});
        const std::int32_t reach = std::max({std::min(a.x, b.x) - extent.xmin, extent.xmax - std::max(a.x, b.x),
                                             std::min(a.y, b.y) - extent.ymin, extent.ymax - std::max(a.y, b.y)});
        for (const std::uint16_t theme : chain.themes)
          visit(Segment{a.x, a.y, b.x, b.y, theme, finest, coarsest, reach});
      });
}

std::vector<Segment> LineHierarchy::segments() const {
  std::vector<Segment> result;
  for (const Chain& chain : chains_) for_each_segment(chain, [&](const Segment& s) { result.push_back(s); });
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<SegmentFeature> LineHierarchy::features(const std::vector<SegmentFeature>& of_whole) const {
  std::vector<SegmentFeature> whole;
  for (const auto& [s, feature] : of_whole) whole.push_back({plan_between(s.a(), s.b(), s.theme), feature});
  std::sort(whole.begin(), whole.end());
  std::vector<SegmentFeature> result;
  for (const Chain& chain : chains_) {
    for_each_segment(chain, [&](const Segment& s) {
      const Segment first = plan_between(chain.vertices[0], chain.vertices[1], s.theme);
      for (const SegmentFeature& f : of_segment(whole, first)) result.push_back({s, f.feature});
    });
  }
  sort_unique(result);
  return result;
}

std::vector<LineHierarchy::VertexLevel> LineHierarchy::levels() const {
  std::vector<VertexLevel> result;
  for (const Chain& chain : chains_) {
    for (std::size_t i = 0; i < chain.vertices.size(); ++i)
      result.push_back({code_of(chain.vertices[i]), chain.levels[i]});
  }
  sort_unique(result);
  return result;
}

std::vector<LineHierarchy::Restored> LineHierarchy::restore(const std::vector<Shortcut>& shortcuts) {
  const auto named = [&](int level, Position p, Position q) {
    const auto [a, b] = std::minmax(p, q);
    return std::binary_search(shortcuts.begin(), shortcuts.end(), Shortcut{level, a, b});
  };
  std::vector<Restored> result;
  for (Chain& chain : chains_) {
    const std::vector<Position>& v = chain.vertices;
    for (int k = 1; k <= coarsest_; ++k) {
      std::size_t from = 0;
      bool any = false;
      for (std::size_t to = 1; to < v.size(); ++to) {
        if (chain.levels[to] < k) {
          any = any || named(k, v[to], v[to]);
          continue;
        }
        if (to > from + 1 && (any || named(k, v[from], v[to]))) {
          const auto first = chain.levels.begin() + static_cast<std::ptrdiff_t>(from) + 1;
          const auto last = chain.levels.begin() + static_cast<std::ptrdiff_t>(to);
          result.push_back({box_of_piece(v, from, to), *std::min_element(first, last) + 1, k});
          std::fill(first, last, static_cast<std::uint8_t>(k));
        }
        from = to;
        any = false;
      }
    }
  }
  return result;
}

}  // namespace itin
