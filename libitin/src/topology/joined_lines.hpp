// Lines joined from edges: from one end or junction to the next.
//
//   for (const JoinedLine& line : joined_lines(edges)) draw(line.vertices);
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace itin {

/// An edge, by the vertices of its ends.
using LineEnds = std::pair<std::uint32_t, std::uint32_t>;

/// A line of at least two vertices; the first and the last are equal where the line is a ring.
struct JoinedLine {
  std::vector<std::uint32_t> vertices;
};

/// Joins edges into lines. Every edge is part of one line, once. Lines begin and end at vertices where other than two
/// edges meet; a line without such a vertex is a ring, which begins at its first vertex. The order of lines depends on
/// the set of edges alone. O(n log n). Precondition: no edge comes twice.
std::vector<JoinedLine> joined_lines(std::span<const LineEnds> edges);

}  // namespace itin
