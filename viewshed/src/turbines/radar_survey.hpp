// How high something must stand to rise above a radar's horizon.
#pragma once

#include <vector>

#include <itin/progress.hpp>
#include <viewshed/turbines.hpp>

#include "request/eye.hpp"
#include "request/void_shadow.hpp"
#include "scene/full_surface.hpp"

namespace itin::viewshed {

/// `radar` is the surface's view from it. For every cell of the surface's grid, metres above its ground, up to
/// kRadarCeiling: NaN above that, and without ground. `shadow` is what ground without data hides from the radar; may be
/// null.
inline constexpr double kRadarCeiling = 1000;
std::vector<float> radar_heights(const RadialSweep::View& radar, const FullSurface& surface, const VoidShadow* shadow,
                                 Progress& progress);

/// What the radar sees of one turbine, metres from its tip down; 0: hidden.
double radar_sees(const RadialSweep::View& radar, const FullSurface& surface, const VoidShadow* shadow,
                  const Turbine& turbine, double ground_m);

}  // namespace itin::viewshed
