// Verifies a pyramid's levels in one cell, against law 2, and mends them there.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "features/contours/line_hierarchy.hpp"
#include "pyramid/difference/leaf_bounds.hpp"
#include "pyramid/levels/whole_levels.hpp"
#include "pyramid/points/working_index.hpp"
#include "triangulate/apex/selection.hpp"

namespace itin {

using RaisedLevels = std::unordered_map<std::uint64_t, int>;  ///< by Morton code

/// Selects level k and coarser.
Selection levels_from(int k, const std::vector<std::int32_t>& tolerances);

/// A task of verification: the leaves of the cell that lie in the box, for these levels.
struct Task {
  CurveRange cell;
  GridBox box;
  unsigned levels;

  bool covers(const Cell& leaf) const { return cell.cell.contains(leaf) && box.contains(square_of(leaf)); }
};

struct CellOutcome {
  RaisedLevels raised;
  /// Points of other cells, with levels, that would mend what still fails here. The other cells see this failure, too.
  std::vector<std::pair<std::uint64_t, int>> left_to_others;
  /// Shortcuts that fail where no point would mend that.
  std::vector<LineHierarchy::Shortcut> failing;
};

/// Replaces the bounds of the task's leaves at its levels. If `mend`, points of the cell are raised until the levels
/// hold in the box, as far as points can mend them. A shortcut fails if it is too far off, along itself or at a vertex
/// that it leaves out. If `mend`, the shortcuts about another edge fail too, where the edge is too far off and no point
/// would break it up. `whole`, which may be null, has levels of the index as it is; it must be null if `mend`.
CellOutcome verify_cell(const WorkingIndex& index, const std::vector<std::int32_t>& tolerances, const Task& task,
                        bool mend, const WholeLevels* whole, LeafBounds& bounds);

}  // namespace itin
