// Drawings of a horizon: the sky line over azimuth, and named places above or below it.
//
//   write_file("view.svg", draw_panorama({"Garth Hill", "2 m above ground", skyline, places}, "view.svg"), false);
#pragma once

#include <string>
#include <vector>

namespace itin::profile {

struct SkylinePoint {
  double azimuth_deg = 0;
  double elevation_deg = 0;  ///< NaN: no ground in that direction
  double distance_m = 0;
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
  std::string note;                   ///< below the title, smaller
  std::vector<SkylinePoint> skyline;  ///< clockwise and evenly spaced; may pass through north
  std::vector<PanoramaPlace> places;  ///< those beyond the sky line's azimuths are left out
};

/// Throws InputError unless the name ends in .svg, .pdf or .png.
void require_panorama_format(const std::string& path);

/// The bytes of a file of the format its name tells. What is near is darker than what is far; places in sight are
/// filled marks, hidden ones hollow. Throws InputError.
std::string draw_panorama(const Panorama& panorama, const std::string& path);

}  // namespace itin::profile
