// The calendar of a year of shadow flicker, as a part of a drawing.
//
//   draw_calendar(drawing, {30, 480, 1160, 800}, calendar, 1);
#pragma once

#include <profile/flicker_calendar.hpp>

#include "drawing/drawing.hpp"

namespace itin::profile {

/// Fills the box with the calendar, the minutes of each day below it, and the legend. `type` is the factor for letters.
void draw_calendar(Drawing& drawing, const Box& box, const FlickerCalendar& calendar, double type);

}  // namespace itin::profile
