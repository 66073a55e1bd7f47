// Shaded relief on the pixels of a picture.
#pragma once

#include <span>
#include <vector>

#include <itin/raster.hpp>
#include <viewshed/relief.hpp>

namespace itin::viewshed {

/// Returns one value per pixel: 0 (darkest) to 1 (brightest), NaN where its height, metres, is NaN. Light comes from
/// the north-west and, weaker, from the west, north and south-west, so that no slope direction is lost.
std::vector<float> hillshade(std::span<const float> heights, const RasterGrid& pixels);

}  // namespace itin::viewshed
