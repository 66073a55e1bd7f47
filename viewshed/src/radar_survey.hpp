// How high something must stand to rise above a radar's horizon.
#pragma once

#include <vector>

#include <itin/tin.hpp>
#include <viewshed/turbines.hpp>

#include "eye.hpp"
#include "least_height.hpp"
#include "triangle_bins.hpp"

namespace itin::viewshed {

/// For every cell of the zone's grid, metres above its ground, up to kRadarCeiling: NaN above that, and without ground.
inline constexpr double kRadarCeiling = 1000;
std::vector<float> radar_heights(const Eye& radar, const Tin& ground, const TriangleBins& bins, const RasterGrid& tiles,
                                 const RasterGrid& grid, const LeastHeights& heights, Progress& progress);

/// What the radar sees of one turbine, metres from its tip down; 0: hidden.
double radar_sees(const Eye& radar, const Tin& ground, const Turbine& turbine, double ground_m,
                  const LeastHeights& heights);

}  // namespace itin::viewshed
