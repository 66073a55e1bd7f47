// The marks of maps, and the samples before the rows of their legends.
#pragma once

#include <profile/map_sheet.hpp>

#include "drawing/drawing.hpp"

namespace itin::profile {

/// Draws a mark; `size` is its height in points.
void draw_symbol(Drawing& drawing, SheetSymbol symbol, Point2 at, double size, const Rgba& colour);

/// Dashes of lines on a map whose letters and symbols have this factor.
std::vector<double> map_dashes(double type);

/// Draws what stands before the text of a row that is no heading. `type` is the factor of letters and symbols.
void draw_sample(Drawing& drawing, const SheetKey& key, const Box& box, double type);

}  // namespace itin::profile
