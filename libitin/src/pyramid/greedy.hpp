// Greedy insertion (Garland and Heckbert 1995) as a Delaunay pyramid (De Floriani 1989), for one tile's points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <itin/geometry.hpp>

namespace itin {

/// The level of each point: the coarsest whose triangulation needs it, so that the Delaunay triangulation of the points
/// of levels >= k keeps within tolerances[k] of every point, for each k >= 1. A proposal: it knows nothing of the
/// neighbouring tiles and looks at points only; verification has the last word (certify.hpp).
///
/// `points` in Morton order, positions distinct; `corners[i]` != 0 forces a point into the coarsest level.
/// `tolerances` in grid units, ascending, the first one 0. Ties go to the first point in order. O(n log n) expected.
std::vector<std::uint8_t> greedy_levels(std::span<const GridPoint> points, std::span<const std::uint8_t> corners,
                                        std::span<const double> tolerances);

}  // namespace itin
