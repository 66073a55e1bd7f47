// Sorts the points of a lattice along the curve.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include <itin/geometry.hpp>

#include "geometry/cell.hpp"
#include "store/radix_sort.hpp"

namespace itin {

/// Sorts points. Precondition: all lie in the cell, on a lattice of these steps.
inline void sort_along_curve(const Cell& cell, std::uint64_t step_x, std::uint64_t step_y,
                             std::vector<GridPoint>& points) {
  // All codes already differ without the low bits, which the lattice's steps leave free.
  const int low_bits = 2 * (std::bit_width(std::min(step_x, step_y)) - 1);
  radix_sort(points, 2 * cell.log2_side - low_bits,
             [&](const GridPoint& p) { return (code_of(p) - cell.code) >> low_bits; });
}

}  // namespace itin
