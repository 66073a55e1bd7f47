// One Tin of the regions that a window was cut into.
#pragma once

#include <span>
#include <vector>

#include <itin/tin.hpp>

#include "geometry/cell.hpp"
#include "triangulate/region.hpp"

namespace itin {

/// Regions agree where they overlap, so what several hold is taken once. `cells` are the regions', disjoint and in
/// Morton order. Linear time, for only what lies across cells' borders is looked up.
Tin assemble(std::vector<RegionMesh> regions, std::span<const Cell> cells, const Grid& grid);

}  // namespace itin
