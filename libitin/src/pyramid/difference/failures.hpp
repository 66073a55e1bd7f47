// Tells where a coarse surface is too far from the full one, and which vertices of the full one would mend that.
//
// Vertices are identified by their Morton codes. So cells that see the same failure, each within a mesh of its own,
// agree on the vertices that would mend it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace itin {

/// A place where an edge of the full surface crosses one of the coarse surface, too far above or below it.
struct FailingCrossing {
  std::uint32_t coarse_from, coarse_to;  ///< the coarse edge's ends, the lesser first
  std::int32_t size;                     ///< how far apart in height the two are, grid units, rounded up
  /// The full edge's end that is nearer to the coarse edge, its other end, and the opposite corners of the triangles at
  /// the full edge, ascending. Where the edge has one triangle, its corner stands twice.
  std::array<std::uint64_t, 4> vertices;
};

struct Failures {
  /// The vertex that is farthest off, of each coarse triangle that has vertices too far off; ties go to the least code.
  std::vector<std::uint64_t> worst_of_faces;
  std::vector<FailingCrossing> crossings;

  void clear() { worst_of_faces.clear(), crossings.clear(); }

  /// Calls visit with the crossings along each coarse edge, the worst one first. Ties go to the crossing that comes
  /// first by its ends' codes. Cells that leave points to each other must agree on them, or none would ever raise any.
  template <class Visit>
  void for_each_edge(const Visit& visit) const {
    const auto coarse_edge = [](const FailingCrossing& c) { return std::pair(c.coarse_from, c.coarse_to); };
    const auto key = [&](const FailingCrossing& c) {
      return std::tuple(coarse_edge(c), -c.size, std::minmax(c.vertices[0], c.vertices[1]));
    };
    std::vector<FailingCrossing> sorted = crossings;
    std::sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    for (auto first = sorted.begin(); first != sorted.end();) {
      const auto last =
          std::find_if(first, sorted.end(), [&](const auto& c) { return coarse_edge(c) != coarse_edge(*first); });
      visit(std::span<const FailingCrossing>(first, last));
      first = last;
    }
  }
};

/// The worst vertex of one face so far.
class WorstVertex {
 public:
  void add(std::int32_t size, std::uint64_t code) {
    if (size > size_ || (size == size_ && code < code_)) size_ = size, code_ = code;
  }
  /// Whether any vertex was added.
  bool found() const { return size_ > 0; }
  std::uint64_t code() const { return code_; }

 private:
  std::int32_t size_ = 0;
  std::uint64_t code_ = 0;
};

}  // namespace itin
