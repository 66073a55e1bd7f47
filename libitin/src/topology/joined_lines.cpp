#include "topology/joined_lines.hpp"

#include <algorithm>
#include <utility>

namespace itin {

namespace {

/// The edges, each seen from both ends.
class LineGraph {
 public:
  explicit LineGraph(std::span<const LineEnds> edges) {
    for (const auto& [from, to] : edges) {
      ends_.emplace_back(from, to);
      ends_.emplace_back(to, from);
    }
    std::sort(ends_.begin(), ends_.end());
    taken_.resize(ends_.size());
  }

  std::vector<JoinedLine> join() {
    std::vector<JoinedLine> lines;
    for (const bool rings : {false, true})
      for (std::size_t i = 0; i < ends_.size(); ++i)
        if (!taken_[i] && (rings || !passes(ends_[i].first))) lines.push_back(line_from(i));
    return lines;
  }

 private:
  std::pair<std::size_t, std::size_t> edges_at(std::uint32_t vertex) const {
    const auto first = std::lower_bound(ends_.begin(), ends_.end(), std::pair(vertex, 0U));
    const auto last = std::find_if(first, ends_.end(), [&](const auto& end) { return end.first != vertex; });
    return {static_cast<std::size_t>(first - ends_.begin()), static_cast<std::size_t>(last - ends_.begin())};
  }
  /// Tells whether a line goes on at the vertex.
  bool passes(std::uint32_t vertex) const {
    const auto [first, last] = edges_at(vertex);
    return last - first == 2;
  }

  void take(std::size_t edge) {
    const auto [from, to] = ends_[edge];
    const auto back = std::lower_bound(ends_.begin(), ends_.end(), std::pair(to, from));
    taken_[edge] = taken_[static_cast<std::size_t>(back - ends_.begin())] = true;
  }

  JoinedLine line_from(std::size_t edge) {
    JoinedLine line{{ends_[edge].first}};
    while (true) {
      take(edge);
      const std::uint32_t vertex = ends_[edge].second;
      line.vertices.push_back(vertex);
      if (!passes(vertex)) return line;
      const std::size_t first = edges_at(vertex).first;
      if (taken_[first] && taken_[first + 1]) return line;  // the ring is closed
      edge = taken_[first] ? first + 1 : first;
    }
  }

  std::vector<LineEnds> ends_;  ///< vertex, and the vertex at the other end
  std::vector<bool> taken_;
};

}  // namespace

std::vector<JoinedLine> joined_lines(std::span<const LineEnds> edges) {
  return LineGraph(edges).join();
}

}  // namespace itin
