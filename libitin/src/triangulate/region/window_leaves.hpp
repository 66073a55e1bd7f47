// The leaves of an index that a window may need. Its box may have many more.
#pragma once

#include <vector>

#include "store/codec/point_index.hpp"
#include "triangulate/apex/selection.hpp"
#include "triangulate/region/grid_window.hpp"

namespace itin {

/// Returns the leaves that may hold something selected within a margin of the window, grid units; each once. Uses all
/// threads.
std::vector<Leaf> leaves_about(const PointIndex& index, const Selection& selection, const GridWindow& window,
                               double margin);

/// Leaves out the leaves that are farther away than the margin.
void keep_leaves_about(const GridWindow& window, double margin, std::vector<Leaf>& leaves);

}  // namespace itin
