// What a mode's rasters hold before any cell is looked at.
#pragma once

#include <cstddef>

#include <viewshed/result.hpp>

namespace itin::viewshed {

/// The values of the request's mode for `cells` cells that are outside every field of view.
ModeValues values_outside(const Request& request, std::size_t cells);

}  // namespace itin::viewshed
