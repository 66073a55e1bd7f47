// What shuts in the ground that standing features change: edges of the full surface that no feature of their theme
// cuts, so nothing may cut them where that theme is there alone, lest the triangles beyond become others. Where another
// theme's lines cross one it makes way for them, when they are there.
#pragma once

#include <cstdint>
#include <vector>

#include "features/plan_overlay.hpp"
#include "features/planar.hpp"

namespace itin {

struct BorderEdge {
  std::uint32_t theme = 0;  ///< from 0
  GridEdge edge;            ///< its lesser end first
  friend auto operator<=>(const BorderEdge&, const BorderEdge&) = default;
};

struct PlacedBorder {
  BorderEdge border;
  std::vector<std::uint32_t> makes_way_for;  ///< owners, ascending
};

/// Those that are still needed among planar lines: a line of the terrain, or one of the same theme, does as well.
/// `terrain`: whether an owner is a theme of the terrain.
std::vector<PlacedBorder> place_borders(std::vector<BorderEdge> borders, const PlanarLines& lines,
                                        const std::vector<bool>& terrain);

}  // namespace itin
