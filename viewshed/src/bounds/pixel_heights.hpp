// How high a surface is at the pixels of a picture.
#pragma once

#include <vector>

#include <itin/lattice_tin.hpp>
#include <itin/raster.hpp>
#include <itin/tin.hpp>

namespace itin::viewshed {

/// Returns the heights at the pixels' centres, metres; NaN where there is no surface. O(triangles + pixels).
std::vector<float> heights_at(const Tin& tin, const RasterGrid& pixels);

/// Returns the heights of a lattice in O(pixels). Precondition: all heights are read.
std::vector<float> heights_at(const LatticeTin& lattice, const RasterGrid& pixels);

}  // namespace itin::viewshed
