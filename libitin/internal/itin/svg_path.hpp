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

/// Returns the value rounded to steps, as short as can be: "-.5", "12.25".
std::string svg_number(double value, double step);

/// Writes the first point, and then the way from each point to the next. Rounding does not add up: the drawn line is
/// nowhere farther from the given one than the tolerance and one step. Empty for no points.
std::string svg_path(std::span<const Point2> points, const SvgPrecision& precision);

}  // namespace itin
