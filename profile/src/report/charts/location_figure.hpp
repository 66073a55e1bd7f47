// The map of where a line runs, as a figure in a column of a page.
#pragma once

#include <profile/map_sheet.hpp>

#include "drawing/drawing.hpp"

namespace itin::profile {

/// Draws the map to scale, with a title above it, and its scale and what it shows below.
void draw_location(Drawing& drawing, const Box& area, const MapSheet& map);

}  // namespace itin::profile
