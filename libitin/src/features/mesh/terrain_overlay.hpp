// Features laid over the terrain's own edges, so that they only raise it, but for flat foundations. Outside of
// footprints the surface with features is the bare terrain; inside it is nowhere lower.
//
// All edges of every terrain triangle that a foot or an eaves line crosses become lines, cut at what they cross.
// Between feet and eaves they belong to the wall. Outside they lie on the ground and keep the triangulation as it was
// there. So each piece of the surface outside of tops lies in one terrain triangle; its corners are no lower than that
// triangle, and nor is the piece. A top that the terrain pierces takes all of the terrain's edges up, each vertex as
// high as the higher of roof and terrain, which is no lower than either in between.
//
// The feet of a flat foundation lie at its base instead, and stay lines on the ground: a piece of the ground beside
// them lies in one terrain triangle as well, and differs from it by no more than its corners do. Under such a footprint
// no edge of the terrain is kept, and nothing pierces its top.
//
// An edge of the terrain may run along a wall from one feature's eaves to another's. It is cut where the one wall ends
// and the other begins, at the height of the eaves there. Uncut, it would rise to the other's eaves over all of its
// length.
//
// Positions are rounded to the grid, so heights are as said here to within a grid step, or a grid step times the slope.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "features/mesh/eaves_abreast.hpp"
#include "features/mesh/feature_group.hpp"
#include "features/mesh/ground_border.hpp"

namespace itin {

/// A footprint with its top, whose lines have been made already.
struct CoveredGround {
  std::uint32_t feature = 0;         ///< the feature's number
  std::optional<double> above;       ///< if its top follows the terrain already: how far above it, grid units
  std::optional<std::int32_t> base;  ///< a flat foundation: its feet lie at this height, grid units
  GridPolygons footprint, top;
  std::vector<WayAcross> across;  ///< where edges of the terrain are cut that run along its walls into others'
};

struct OverlaidLines {
  std::vector<PlacedSegment> segments;
  ChangedGround ground;
  std::map<std::uint32_t, std::int32_t> pierced;  ///< features, and how far the terrain rises above their tops
};

/// Lays lines over the terrain. `segments` must be planar, feet first, and lie on the terrain.
OverlaidLines lay_over(const TerrainHeights& terrain, std::vector<PlacedSegment> segments,
                       const std::vector<CoveredGround>& covered, const Progress& progress);

}  // namespace itin
