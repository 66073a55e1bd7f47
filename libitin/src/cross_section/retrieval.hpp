// Cross-sections by retrieving one triangle after another, on any index: cross_section() without a Store.
#pragma once

#include <itin/cross_section.hpp>
#include <itin/section_line.hpp>

#include "store/codec/point_index.hpp"
#include "triangulate/apex/selection.hpp"

namespace itin {

CrossSection retrieve_section(const PointIndex& index, const Selection& selection, const SectionLine& line,
                              const Progress& progress = NoProgress());

}  // namespace itin
