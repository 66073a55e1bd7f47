// Writes imported points that are not in the surface into the store (store/set_aside.hpp).
#pragma once

#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

#include "pyramid/points/sorted_points.hpp"
#include "store/store_writer.hpp"

namespace itin {

/// Writes the points of the ground that were dropped, and the points under vertices of lines. `points` must be as the
/// surface was made of them.
void set_points_aside(const SortedPoints& points, const std::vector<SourceInfo>& sources, StoreWriter& writer,
                      Progress& progress);

}  // namespace itin
