// The slow, obviously right cross-section: every triangle is cut by the line, and the pieces are put in order.
//
// A breakpoint has the theme of the vertex that it is, or of the edge or the triangle that it lies within, by whatever
// triangle it is found.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include <itin/cross_section.hpp>
#include <itin/section_line.hpp>

namespace itin::test {

/// A corner of a triangle, and the theme of the feature that it is part of; 0: none.
struct ThemedPoint : GridPoint {
  std::uint16_t theme = 0;
};
using ThemedTriangle = std::array<ThemedPoint, 3>;

struct ThemedCrossing : SectionCrossing {
  std::uint16_t theme = 0;
};

/// The theme of an edge or a triangle: the least theme of its vertices that have one, or 0.
inline std::uint16_t theme_of(std::initializer_list<std::uint16_t> vertices) {
  std::uint16_t least = 0;
  for (const std::uint16_t theme : vertices)
    if (theme != 0 && (least == 0 || theme < least)) least = theme;
  return least;
}

/// Returns where the line, prolonged, meets a closed triangle: the first and the last crossing, or the only one.
inline std::vector<ThemedCrossing> crossings_of(const SectionLine& line, const ThemedTriangle& triangle) {
  std::vector<ThemedCrossing> found;
  for (std::size_t i = 0; i < 3; ++i) {
    const ThemedPoint &p = triangle[i], &q = triangle[(i + 1) % 3];
    if (line.side(p) == 0) found.push_back({line.crossing(p), p.theme});
    if ((line.side(p) < 0 && line.side(q) > 0) || (line.side(p) > 0 && line.side(q) < 0)) {
      found.push_back({line.crossing(p, q), theme_of({p.theme, q.theme})});
    }
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
  return found;
}

/// The theme of what the line passes through between its crossings: an edge, where two corners lie on it.
inline std::uint16_t theme_between(const SectionLine& line, const ThemedTriangle& triangle) {
  std::vector<std::uint16_t> on_line, all;
  for (const ThemedPoint& p : triangle) {
    all.push_back(p.theme);
    if (line.side(p) == 0) on_line.push_back(p.theme);
  }
  return on_line.size() == 2 ? theme_of({on_line[0], on_line[1]}) : theme_of({all[0], all[1], all[2]});
}

inline CrossSection slow_section(const SectionLine& line, const std::vector<ThemedTriangle>& triangles) {
  std::vector<SectionPiece> pieces;
  CrossSection section;
  section.length = line.length();
  for (const ThemedTriangle& triangle : triangles) {
    const std::vector<ThemedCrossing> found = crossings_of(line, triangle);
    if (found.empty()) continue;
    const auto piece = line.clip(found.front(), found.back());
    if (!piece) continue;
    pieces.push_back(*piece);
    for (const SectionCrossing& end : {piece->from, piece->to}) {
      const auto met = std::find_if(found.begin(), found.end(), [&](const auto& c) { return c.t == end.t; });
      const std::uint16_t theme = met != found.end() ? met->theme : theme_between(line, triangle);
      section.breakpoints.push_back({end.distance, end.position, theme});
    }
  }
  const auto less = [](const Breakpoint& a, const Breakpoint& b) {
    return std::tie(a.distance, a.position.x, a.position.y, a.position.z, a.theme) <
           std::tie(b.distance, b.position.x, b.position.y, b.position.z, b.theme);
  };
  std::sort(section.breakpoints.begin(), section.breakpoints.end(), less);
  const auto same = [](const Breakpoint& a, const Breakpoint& b) {
    return a.distance == b.distance && a.position == b.position;
  };
  auto& b = section.breakpoints;
  b.erase(std::unique(b.begin(), b.end(), same), b.end());
  std::sort(pieces.begin(), pieces.end(),
            [](const SectionPiece& p, const SectionPiece& q) { return p.from.distance < q.from.distance; });
  double covered = 0;
  for (const SectionPiece& piece : pieces) {
    if (piece.from.distance > covered) section.gaps.push_back({covered, piece.from.distance});
    covered = std::max(covered, piece.to.distance);
  }
  if (pieces.empty() || covered < line.length()) section.gaps.push_back({covered, line.length()});
  return section;
}

/// Makes the section of triangles without features.
inline CrossSection slow_section(const SectionLine& line, const std::vector<std::array<GridPoint, 3>>& triangles) {
  std::vector<ThemedTriangle> themed;
  for (const auto& [a, b, c] : triangles) themed.push_back({ThemedPoint{a}, ThemedPoint{b}, ThemedPoint{c}});
  return slow_section(line, themed);
}

}  // namespace itin::test
