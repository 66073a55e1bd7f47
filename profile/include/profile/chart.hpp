// Charts of profiles: elevation over distance, several surfaces on one pair of axes.
//
//   write_file("ridge.svg", draw_chart({"Garth Hill", "", {{"full detail", profile}}}, "ridge.svg"), false);
#pragma once

#include <string>
#include <vector>

#include <profile/profile.hpp>

namespace itin::profile {

struct ChartSeries {
  std::string name;
  Profile profile;
};

struct Chart {
  std::string title;
  std::string note;                 ///< below the title, smaller
  std::vector<ChartSeries> series;  ///< the first is drawn as ground, the others as lines over it
  Profile ground;                   ///< of the first, without standing features; no points where it has none
  std::vector<std::string> themes;  ///< names by ProfilePoint::theme, of those features
  std::vector<double> corners_m;    ///< where along the profile its path turns
};

/// Throws InputError unless the name ends in .svg, .pdf or .png.
void require_chart_format(const std::string& path);

/// The bytes of a file of the format its name tells. Vertical exaggeration is stated on the chart. Throws InputError.
std::string draw_chart(const Chart& chart, const std::string& path);

}  // namespace itin::profile
