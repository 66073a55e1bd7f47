// The lines of a theme, joined from the edges of a Tin: from one end or junction to the next.
//
//   for (const JoinedLine& line : joined_lines(tin, theme)) draw(line.vertices);
#pragma once

#include <cstdint>
#include <vector>

#include <itin/tin.hpp>

namespace itin {

/// Indices into Tin::vertices, at least two; the first and the last are one where the line is a ring.
struct JoinedLine {
  std::vector<std::uint32_t> vertices;
};

/// Every edge of the theme is part of one line, once. Lines begin and end at vertices where other than two of the
/// theme's edges meet; what has none is a ring, which begins at its first vertex. The same order for the same Tin.
/// O(n log n).
std::vector<JoinedLine> joined_lines(const Tin& tin, std::uint16_t theme);

}  // namespace itin
