// A visibility index by rays: each observer looks along rays in all directions, over the posts of a lattice.
#pragma once

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/visibility_index.hpp>

#include "index/index_part.hpp"
#include "index/ray_walk.hpp"

namespace itin::viewshed {

/// Returns the direction of a ray, radians clockwise from grid north. No ray runs along the edges of a lattice.
double azimuth_of_ray(unsigned ray, unsigned rays);

/// Looks along the layout's rays. Precondition: it has some. Throws as index_part() does.
IndexPart index_part_by_rays(const Store& store, const IndexRequest& request, const IndexLayout& layout,
                             const CellRectangle& cells, Progress& progress,
                             Instructions instructions = instructions_here().back());

}  // namespace itin::viewshed
