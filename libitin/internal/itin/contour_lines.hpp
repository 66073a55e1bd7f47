// Lines of equal value over a raster.
//
//   for (const std::vector<Point2>& line : contour_lines(grid, heights_m, 250)) ...
#pragma once

#include <span>
#include <vector>

#include <itin/raster.hpp>

namespace itin {

/// Returns where the values at the cells' centres, taken as linear between neighbours, equal `level`. The polylines
/// have higher values on their left; closed ones repeat their first point at the end. Others end at the grid's edges,
/// or where the cell of a NaN begins. Precondition: values.size() == grid.cell_count(). O(cells).
std::vector<std::vector<Point2>> contour_lines(const RasterGrid& grid, std::span<const float> values, double level);

}  // namespace itin
