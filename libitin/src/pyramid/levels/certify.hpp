// Verification of the pyramid against law 2, and the certificates that it gives.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <itin/progress.hpp>

#include "features/contours/line_hierarchy.hpp"
#include "pyramid/difference/leaf_bounds.hpp"
#include "pyramid/levels/post_hierarchy.hpp"
#include "pyramid/points/working_index.hpp"

namespace itin {

/// Puts the vertices that these shortcuts (ascending) leave out back into the index, and says which.
using RestoreLines = std::function<std::vector<LineHierarchy::Restored>(const std::vector<LineHierarchy::Shortcut>&)>;

/// Raises levels in the index until |T_0 - T_k| <= tolerances[k] everywhere, for each k >= 1, and returns the bounds by
/// leaf. `tolerances` are in whole grid units, level 0 first. Leaves without ground keep empty bounds.
///
/// The work goes in rounds. The first rounds measure everything, against real windows of the whole. They put back the
/// vertices of shortcuts that are too far off, along themselves or at a vertex that they leave out. In the later rounds
/// each cell that fails raises its own points until its part holds while its neighbours stay as they were. Where no
/// point would help, shortcuts about the place are put back, too. Cells near which a neighbour raised something, or
/// lines were put back, are verified again. So the outcome depends on the points alone, not on threads. Throws Error
/// where a level fails and nothing is left to put back.
///
/// Where posts of the hierarchy are raised, its fine levels stay closed.
///
/// `long_triangles`: coarse triangles are long, as across the sea. Then coarse levels are held as a whole
/// (whole_levels.hpp) in the first rounds. In the later rounds the levels change, and few cells are left.
LeafBounds certify(WorkingIndex& index, const std::vector<std::int32_t>& tolerances, const PostHierarchy& posts,
                   bool long_triangles, const RestoreLines& restore, Progress& progress);

}  // namespace itin
