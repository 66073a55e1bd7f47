// Lines joined from edges: from one end or junction to the next.
//
//   for (const JoinedLine& line : joined_lines(edges)) draw(line.vertices);
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace itin {

/// The vertices of its ends.
using LineEnds = std::pair<std::uint32_t, std::uint32_t>;

/// At least two vertices; the first and the last are one where the line is a ring.
struct JoinedLine {
  std::vector<std::uint32_t> vertices;
};

/// Every edge is part of one line, once. Lines begin and end at vertices where other than two edges meet; what has none
/// is a ring, which begins at its first vertex. Their order depends on the set of edges alone. O(n log n).
/// Precondition: no edge comes twice.
std::vector<JoinedLine> joined_lines(std::span<const LineEnds> edges);

}  // namespace itin
