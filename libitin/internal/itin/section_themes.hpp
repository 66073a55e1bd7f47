// Which feature the parts of a line over a surface lie within, by the themes of what the line crosses; 0 is the ground.
#pragma once

#include <algorithm>
#include <cstdint>

namespace itin {

/// Returns the theme of an edge from the themes of its ends, or of a triangle from those of two of its corners. An
/// outline's edges have no theme, as their ends have none. Two different themes come together in a party wall only.
inline std::uint16_t theme_of_edge(std::uint16_t a, std::uint16_t b) {
  return a == 0 || b == 0 ? std::max(a, b) : std::min(a, b);
}

/// Returns the theme of a line's piece between two crossings, each with its theme and its height.
inline std::uint16_t theme_of_piece(std::uint16_t a, double height_a, std::uint16_t b, double height_b) {
  if (a == 0 || b == 0) return std::max(a, b);
  return height_a >= height_b ? a : b;
}

}  // namespace itin
