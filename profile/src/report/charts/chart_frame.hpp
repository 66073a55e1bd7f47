// The frame of a chart: box, ticks, labels and titles of two axes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "drawing/axis.hpp"
#include "drawing/drawing.hpp"

namespace itin::profile {

inline constexpr Colour kReportInk{0.13, 0.13, 0.13, 1}, kReportGrey{0.45, 0.45, 0.45, 1},
    kReportFaint{0.84, 0.84, 0.84, 1};

struct ChartFrame {
  Box box;  ///< in the drawing, y downwards
  Axis x, y;
  std::string x_title, y_title;
  int x_ticks = 10, y_ticks = 8;

  Point2 at(double x_value, double y_value) const { return {x.at(x_value), y.at(y_value)}; }
};

/// A frame whose axes fill the box; low and high are data.
ChartFrame make_frame(const Box& box, double x_low, double x_high, double y_low, double y_high);

/// Draws ticks, their labels and the titles outside the box. `x_label` makes a tick's text from its value and the step.
void draw_frame(Drawing& drawing, const ChartFrame& frame,
                const std::function<std::string(double, double)>& x_label = tick_label);

/// An item of a legend, which has samples of colour with their names from left to right and starts anew where a line is
/// full.
struct LegendItem {
  std::string name;
  Stroke stroke;
  bool area = false;
};
void draw_legend(Drawing& drawing, Point2 at, double width, const std::vector<LegendItem>& items);

}  // namespace itin::profile
