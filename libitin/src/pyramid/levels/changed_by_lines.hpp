// Finds where lines that were put into a surface may have changed it.
#pragma once

#include <vector>

#include "store/codec/point_index.hpp"
#include "triangulate/apex/selection.hpp"

namespace itin {

/// Lines, near each other, have become edges of the selected surface in place of shortcuts, each within one of these
/// boxes. Returns a box for each line that holds all triangles that the line has caused.
///
/// A constrained Delaunay triangle is new where it meets a line, or where the line hides a vertex in its circumdisc
/// from it. Then its circumdisc reaches the line, and so do those of all triangles between, up to the line.
std::vector<GridBox> changed_by_lines(const PointIndex& index, const Selection& selection,
                                      const std::vector<GridBox>& lines);

}  // namespace itin
