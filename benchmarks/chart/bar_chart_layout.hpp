// The positions of everything in a bar chart, in points, y downwards.
#pragma once

#include <string>
#include <vector>

#include "chart/bar_chart.hpp"
#include "drawing/axis.hpp"

namespace itin::bars {

struct PlacedText {
  Point2 anchor;
  std::string text;
  profile::Lettering lettering;
};

struct PlacedBar {
  Box box;
  std::size_t series = 0;
};

struct BarChartLayout {
  double width = 0, height = 0;
  Box frame;  ///< about the bars
  profile::Axis axis;
  std::vector<double> ticks;
  std::vector<PlacedBar> bars, swatches;  ///< swatches are the legend's
  std::vector<Box> clearings;             ///< kept free of lines, for the texts at the bars' ends
  std::vector<PlacedText> texts;
};

/// Lays out a chart. No texts overlap, and none leaves the page; texts too long for it are cut.
BarChartLayout lay_out(const BarChart& chart);

}  // namespace itin::bars
