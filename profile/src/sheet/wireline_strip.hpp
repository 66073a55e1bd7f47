// A field of view of a wireline in a frame on paper, with bearings along its edges.
#pragma once

#include <profile/wireline.hpp>

#include "drawing/drawing.hpp"

namespace itin::profile {

enum class StripProjection { kPlanar, kCylindrical };

struct WirelineStrip {
  StripProjection projection = StripProjection::kCylindrical;
  Box frame;                ///< points
  double principal_mm = 0;  ///< the distance from which the strip is seen as in nature
  double centre_deg = 0;    ///< bearing of the strip's middle
  double width_deg = 90;
  double weight = 1;  ///< factor for the width of all lines: wide sheets are seen from farther away
};

/// How far, in points, the horizon must lie below the middle of the frame for the highest tip in it to be seen, and the
/// skyline above each turbine and in the middle, as far as no tip leaves the frame for that.
double horizon_shift(const Wireline& view, const WirelineStrip& strip);

/// Draws the strip. Throws InputError where the view does not hold the field.
void draw_strip(Drawing& drawing, const Wireline& view, const WirelineStrip& strip);

}  // namespace itin::profile
