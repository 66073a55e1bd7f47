// A map sheet as a page among others.
#pragma once

#include <profile/map_sheet.hpp>

#include "drawing/drawing.hpp"

namespace itin::profile {

/// Draws the sheet on a page that has the size of its paper.
void draw_map_page(Drawing& drawing, const MapSheet& sheet);

}  // namespace itin::profile
