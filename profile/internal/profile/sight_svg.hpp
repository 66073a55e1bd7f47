// The drawing of a sight line for pages that other libraries and the program write.
//
//   html += "<img src=\"data:image/svg+xml;base64," + base64(profile::sight_svg(report, 842, 420)) + "\">";
#pragma once

#include <string>

#include <profile/los.hpp>

namespace itin::profile {

/// Returns terrain, ray, zones, critical point and legend as an SVG of this size, in points. Throws Error when drawing
/// fails.
std::string sight_svg(const LosReport& report, double width, double height);

}  // namespace itin::profile
