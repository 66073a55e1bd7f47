// Makes one Tin of the regions that a window was cut into.
#pragma once

#include <span>
#include <vector>

#include <itin/tin.hpp>

#include "geometry/cell.hpp"
#include "triangulate/region/region.hpp"

namespace itin {

/// Joins the regions. They agree where they overlap, so items that several regions hold are taken once. `cells` are the
/// regions', disjoint and in Morton order. Linear time, as only items across cells' borders are looked up.
Tin assemble(std::vector<RegionMesh> regions, std::span<const Cell> cells, const Grid& grid);

}  // namespace itin
