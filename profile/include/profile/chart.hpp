// Draws charts: of profiles, elevation over distance, with several surfaces on one pair of axes; and of horizons, the
// sky line over azimuth with named places above or below it.
//
//   profile::Chart chart;
//   chart.title = "Garth Hill";
//   chart.series = {{"full detail", line}};
//   std::ofstream("ridge.svg") << profile::draw_chart(chart, "ridge.svg");
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
  std::string note;                 ///< smaller, below the title
  std::vector<ChartSeries> series;  ///< the first is drawn as ground, the others as lines over it
  Profile ground;                   ///< the first one's ground, without raised features; no points where it has none
  std::vector<std::string> themes;  ///< names of the features' themes, by ProfilePoint::theme
  std::vector<double> corners_m;    ///< distances along the profile at which its path turns
};

/// Throws InputError unless the name ends in .svg, .pdf or .png.
void require_chart_format(const std::string& path);

/// Returns the bytes of a file in the format that its name tells. The chart states the vertical exaggeration. Throws
/// InputError.
std::string draw_chart(const Chart& chart, const std::string& path);

struct SkylinePoint {
  double azimuth_deg = 0;
  double elevation_deg = 0;  ///< NaN: no ground in that direction
  double distance_m = 0;
  bool data_edge = false;  ///< the data ends there
};

struct PanoramaPlace {
  std::string name;
  double azimuth_deg = 0;
  double elevation_deg = 0;
  double distance_m = 0;
  bool visible = false;
};

struct Panorama {
  std::string title;
  std::string note;                   ///< smaller, below the title
  std::vector<SkylinePoint> skyline;  ///< clockwise and evenly spaced; may pass through north
  std::vector<PanoramaPlace> places;  ///< places beyond the sky line's azimuths are left out
};

/// Throws InputError unless the name ends in .svg, .pdf or .png.
void require_panorama_format(const std::string& path);

/// Returns the bytes of a file in the format that its name tells. Near ground is darker than far ground; places in
/// sight are filled marks, hidden ones hollow. Names that have no room near their places are left out and counted,
/// first those of hidden and far places. Throws InputError.
std::string draw_panorama(const Panorama& panorama, const std::string& path);

}  // namespace itin::profile
