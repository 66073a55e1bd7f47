// Finds where walls may be cut across, from a place on the outline to the eaves abreast of it.
//
// A wall rises between its outline and the eaves, the wall offset within. Where the outline's neighbour changes, from
// bare ground to a higher block, the outline's height leaps. Were the eaves straight past such a leap, a triangle could
// reach from their next vertex, however far away, to the higher block's corner, and a strip of the wall would rise
// towards it. With a vertex abreast of the leap no triangle passes the leap. An edge of the terrain that runs along the
// wall, from one block's eaves to another's, still would; it is cut on its way (terrain_overlay.hpp).
#pragma once

#include <vector>

#include "features/mesh/roof.hpp"
#include "features/plan/plan_overlay.hpp"

namespace itin {

/// A way from a place on the outline to the nearest position on the eaves, at the height of the eaves.
struct WayAcross {
  Position from;
  GridPoint to;
};

/// Returns the ways from the places, without ways longer than about a corner of a right angle needs. O(n log n) as long
/// as few lines of eaves are longer than the distance between places.
std::vector<WayAcross> ways_across(const std::vector<RoofLine>& lines, std::vector<Position> places, double offset);

/// Gives the eaves vertices where the ways across end.
void split_abreast(std::vector<RoofLine>& lines, std::vector<Position> places, double offset);

}  // namespace itin
