// Lines as the paths of an SVG, in few bytes.
//
//   svg += "<path d=\"" + svg_path(points, {.tolerance = 0.07, .step = 0.01}) + "\"/>";
#pragma once

#include <span>
#include <string>

#include <itin/geometry.hpp>

namespace itin {

struct SvgPrecision {
  double tolerance = 0;  ///< points nearer to the rest of the line are left out
  double step = 0.01;    ///< coordinates are multiples of it: 1, 0.1, 0.01 ...
};

/// In steps, as short as can be: "-.5", "12.25".
std::string svg_number(double value, double step);

/// From the first point on by the way from each to the next. Rounding does not add up: what is drawn is nowhere farther
/// from the line than the tolerance and one step. Empty for no points.
std::string svg_path(std::span<const Point2> points, const SvgPrecision& precision);

}  // namespace itin
