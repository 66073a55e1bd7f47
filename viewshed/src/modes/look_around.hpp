// Looks from every eye at every cell of a surface, tile by tile.
#pragma once

#include <vector>

#include <itin/progress.hpp>
#include <viewshed/viewshed.hpp>

#include "modes/observation.hpp"
#include "request/eye.hpp"
#include "scene/full_surface.hpp"

namespace itin::viewshed {

/// `studies` are those of the surface, where the mode needs any. `views` are the eyes', or none, and then they are made
/// when they are needed, for some hundreds of eyes at a time. Fills the result's rasters and counts; its request, of
/// which the observations are, says in what mode, its grid is the surface's, and `crosses_voids` tells whether
/// NoData::kBlock matters. Memory: 36 kB per thread, what a mode keeps of all cells where there are hundreds of eyes,
/// and, where it does, what edges of voids each eye sees from behind. Throws Cancelled.
void look_around(const FullSurface& surface, const TriangleStudies* studies, Observations& observations,
                 const std::vector<Eye>& eyes, const std::vector<RadialSweep::View>& views, Result& result,
                 Progress& progress);

}  // namespace itin::viewshed
