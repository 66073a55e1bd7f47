// Shaded relief of a Tin on the pixels of a picture.
#pragma once

#include <vector>

#include <itin/raster.hpp>
#include <itin/tin.hpp>

namespace itin::viewshed {

/// What level ground has.
inline constexpr double kLevelShade = 0.643;

/// One value a pixel: 0 (darkest) to 1 (brightest), NaN where there is no surface. Light comes from the north-west and,
/// weaker, from the west, north and south-west, so that no slope direction is lost.
std::vector<float> hillshade(const Tin& tin, const RasterGrid& pixels);

}  // namespace itin::viewshed
