// Draws tables on sheets of paper.
#pragma once

#include <itin/geometry.hpp>
#include <profile/sheet_table.hpp>

#include "drawing/drawing.hpp"

namespace itin::profile {

/// Draws the table's title, headings and as many rows as the box has room for. Rows left out are counted in a last
/// line.
void draw_sheet_table(Drawing& drawing, const SheetTable& table, const Box& box, double type);

/// The height of the table with all of its rows.
double height_of_table(const SheetTable& table, double type);

}  // namespace itin::profile
