// The drawing of a sight line: terrain over the effective Earth, the ray and its Fresnel zones.
#pragma once

#include <vector>

#include <profile/los.hpp>

#include "report/charts/chart_frame.hpp"

namespace itin::profile {

/// Draws the chart, with axes, legend and the stated exaggeration. Elevations are drawn over the curved Earth, so that
/// the ray is straight: lines of equal elevation are arcs, and the vertical axis holds at the ends.
void draw_sight_chart(Drawing& drawing, const Box& area, const LosReport& report);

}  // namespace itin::profile
