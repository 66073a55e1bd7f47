// Roofs over a plan: where they crease, and how high they stand.
//
// Every roof is a continuous, piecewise linear function of plan position, so that ring vertices, creases and the points
// where creases meet the ring carry its exact height (but for the rounding of positions to the grid). Lines come out
// planar.
//   flat      the eaves' height everywhere
//   gabled    two planes that meet in a ridge along the longer axis of the smallest rectangle about the plan; at its
//             ends the ring rises with them, which makes the gables
//   hipped    four planes that rise from the sides of that rectangle: over a rectangle the straight skeleton's roof
//   skeleton  a plane rises from each side of the plan, courtyards' sides included
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <itin/geometry.hpp>

#include "features/plan/plan_overlay.hpp"
#include "store/segments/footprint.hpp"

namespace itin {

/// Heights of a roof, in grid units above the grid's zero.
///
/// Eaves and ridge together determine the slope. If only the ridge is given (the total height), the pitch determines
/// the eaves, which lie at least half way up from the base; a roof that would begin lower gets flatter. If only the
/// eaves are given, the pitch determines the ridge.
struct RoofHeights {
  double base = 0;
  std::optional<double> eaves;
  std::optional<double> ridge;  ///< ridge or eaves, or both, are given
  double slope = 0.7;           ///< the tangent of the pitch
};

struct RoofLine {
  GridPoint a, b;
  bool eaves;  ///< whether it runs along the plan's rings; otherwise it is a crease
};

struct RoofLines {
  std::vector<RoofLine> lines;
  std::string fallback;  ///< why the roof is flat though another was asked for; empty if all is well
};

RoofLines make_roof(RoofKind kind, const GridPolygon& plan, const RoofHeights& heights);

/// A roof's crease or eave with its distances from the eaves, in grid units.
struct SkeletonArc {
  Point2 a, b;
  double rise_a = 0, rise_b = 0;
};
/// The bisectors of the straight skeleton; nothing where CGAL refuses the polygon or answers nonsense.
std::optional<std::vector<SkeletonArc>> straight_skeleton(const GridPolygon& plan);

}  // namespace itin
