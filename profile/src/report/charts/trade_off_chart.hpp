// A chart of heights of one end against the other, with a curve for each requirement.
#pragma once

#include <profile/los.hpp>

#include "report/charts/chart_frame.hpp"

namespace itin::profile {

/// Whether there is a curve to draw.
bool has_trade_off(const LosReport& report);
void draw_trade_off_chart(Drawing& drawing, const Box& area, const LosReport& report);

}  // namespace itin::profile
