// Patches of a raster of heights: cells that hang together and are equally high, after their heights became whole
// steps.
//
//   std::vector<std::int32_t> steps;
//   for (const std::int32_t h : cells.heights) steps.push_back(h == kNoHeight ? 0 : steps_of(h, cells));
//   for (const CellPatch& patch : patches_of(cells, steps)) ...
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "store/segments/footprint.hpp"

namespace itin {

/// A patch of equally high cells. Its rings follow the cells' edges, and have vertices only where they turn. No ring
/// passes through a place twice, and two of them meet in single places at most.
struct CellPatch {
  std::vector<PlanRing> rings;  ///< the outline and its holes
  std::int32_t steps = 0;
};

/// The number of steps that stand for a height above the ground (millimetres); 0 below the threshold, and below zero.
std::int32_t steps_of(std::int64_t above_ground, const HeightCells& rule);

/// Returns the patches in the order of their first cells. `steps` has a number for each cell, row by row; nothing
/// stands where it is 0. Cells that meet at a corner alone are in different patches.
std::vector<CellPatch> patches_of(const HeightCells& cells, std::span<const std::int32_t> steps);

}  // namespace itin
