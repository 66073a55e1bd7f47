// Cross-sections over ground that many lines share, on any index: SectionSurface without a Store.
#pragma once

#include <itin/cross_section.hpp>
#include <itin/section_line.hpp>

#include "cross_section/section_tiles.hpp"

namespace itin {

/// Makes the cross-section of a line; its statistics count what is read and triangulated for this line.
CrossSection tiled_section(SectionTiles& tiles, const SectionLine& line);

}  // namespace itin
