// The slow, obviously right cross-section: every triangle is cut by the line, and the pieces are put in order.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include <itin/cross_section.hpp>
#include <itin/section_line.hpp>

namespace itin::test {

/// Where the line, prolonged, meets a closed triangle: its first and last crossing.
inline std::vector<SectionCrossing> crossings_of(const SectionLine& line, const std::array<GridPoint, 3>& triangle) {
  std::vector<SectionCrossing> found;
  for (std::size_t i = 0; i < 3; ++i) {
    const GridPoint &p = triangle[i], &q = triangle[(i + 1) % 3];
    if (line.side(p) == 0) found.push_back(line.crossing(p));
    if ((line.side(p) < 0 && line.side(q) > 0) || (line.side(p) > 0 && line.side(q) < 0)) {
      found.push_back(line.crossing(p, q));
    }
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
  return found;
}

/// `themes`: of each triangle's feature, if any triangle is part of one. A breakpoint has a theme where all triangles
/// that hold it have one.
inline CrossSection slow_section(const SectionLine& line, const std::vector<std::array<GridPoint, 3>>& triangles,
                                 const std::vector<std::uint16_t>& themes = {}) {
  std::vector<SectionPiece> pieces;
  CrossSection section;
  section.length = line.length();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::vector<SectionCrossing> found = crossings_of(line, triangles[t]);
    if (found.empty()) continue;
    const auto piece = line.clip(found.front(), found.back());
    if (!piece) continue;
    pieces.push_back(*piece);
    const std::uint16_t theme = themes.empty() ? std::uint16_t{0} : themes[t];
    section.breakpoints.push_back({piece->from.distance, piece->from.position, theme});
    section.breakpoints.push_back({piece->to.distance, piece->to.position, theme});
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
  // Among equal ones the first is left, with the least theme: none, if one triangle has none.
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

}  // namespace itin::test
