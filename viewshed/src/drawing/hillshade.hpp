// Shaded relief on the pixels of a picture.
#pragma once

#include <vector>

#include <itin/raster.hpp>
#include <viewshed/relief.hpp>

namespace itin::viewshed {

/// Shades the pixels whose height, metres, is not NaN. Light comes from the north-west and, weaker, from the west,
/// north and south-west, so that no slope direction is lost.
Relief hillshade(const RasterGrid& pixels, std::vector<float> heights_m);

}  // namespace itin::viewshed
