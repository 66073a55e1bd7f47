// How far features bend the ground about them, for bounds of a surface with features that are made from the bare
// ground.
#pragma once

namespace itin::viewshed {

/// Grid units. Features bend the ground about them, at positions rounded to the grid: there it is no lower and no
/// higher than the bare one is so near, but for a rounded height.
inline constexpr double kStepsBeside = 2, kStepsUp = 1;

}  // namespace itin::viewshed
