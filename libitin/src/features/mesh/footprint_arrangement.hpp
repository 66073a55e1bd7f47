// Footprints side by side: from outlines that overlap, touch and cross to disjoint ones that share their vertices, and
// to the rings on which their roofs stand.
//
// Rules.
// - Where footprints overlap, the ground belongs to the one that is higher there, which is what is seen from above.
// - A wall rises within the wall offset inside the outline. Where two footprints touch, the wall stands in the lower
//   one, so that the party line itself lies at the eaves of the higher, and no groove opens between them. Among equals
//   the earlier counts as the higher.
// - So a top is the set of all positions of its footprint that are further than the offset from everything that is
//   neither the footprint itself nor a lower one: tops are never nearer than the offset to the ground or to a higher
//   wall.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <itin/progress.hpp>

#include "features/plan/plan_overlay.hpp"

namespace itin {

/// The height of a plane at (x, y), all in grid units.
struct Plane {
  double x = 0, y = 0, constant = 0;
  double at(Point2 p) const { return x * p.x + y * p.y + constant; }
};

/// A piece of ground that one roof covers.
struct Patch {
  GridPolygons plan;
  Plane top;        ///< decides which patch is higher at a place
  double rank = 0;  ///< decides in which of two neighbours their wall stands
};

struct ArrangedPatch {
  GridPolygons footprint;  ///< disjoint from all others, without what it lost to higher ones or to the grid
  GridPolygons top;        ///< empty where nothing is as wide as twice the offset
  std::string failure;     ///< why there is no top though there may be room
  /// Places where the outline's neighbour changes and neither is lower: the eaves must have vertices abreast of them.
  std::vector<Position> leaps;
  /// Places where its walls end for another's to begin: on the outline, and at corners of higher tops on it.
  std::vector<Position> joints;
};

struct Arrangement {
  std::vector<ArrangedPatch> patches;  ///< in the order they were given
  std::vector<std::pair<GridEdge, std::uint32_t>>
      feet;  ///< edges with ground to their right, and the patch to the left
};

/// Arranges patches. Precondition: offset >= 2 grid units. Throws Cancelled where a progress is given and cancelled.
Arrangement arrange(const std::vector<Patch>& patches, double offset, const Progress* progress = nullptr);

/// Groups the patches whose boxes hang together: each group is ascending, and groups come in the order of their first.
/// Patches of different groups never meet, on the grid or off it.
std::vector<std::vector<std::uint32_t>> groups_of(const std::vector<GridBox>& boxes);

}  // namespace itin
