// How far features bend the ground about them, for bounds of a surface with features that are made from the bare
// ground.
#pragma once

namespace itin::viewshed {

/// Margins in grid units. Near features the surface may differ from the bare ground, at positions rounded to the grid:
/// there it lies between the least and the greatest bare height within kStepsBeside, give or take kStepsUp.
inline constexpr double kStepsBeside = 2, kStepsUp = 1;

}  // namespace itin::viewshed
