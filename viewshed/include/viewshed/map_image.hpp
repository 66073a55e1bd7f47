// A map of a viewshed for reports: hillshade, what is visible, observers, legend, scale bar, north arrow and title.
//
//   viewshed::MapImage map = viewshed::draw_map(tin, result, {.title = "Mast at Caerphilly"});
//   viewshed::write_image("map.png", map, overwrite);
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/tin.hpp>
#include <viewshed/surface.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

struct MapOptions {
  std::string title = "Viewshed";
  std::string subtitle;                             ///< empty: observer and target heights, radius, refraction
  std::string seen = "Visible", unseen = "Hidden";  ///< in the legend, where cells are one of the two
  int map_pixels = 1600;                            ///< of the longer side of the map proper, 200 to 16000
};

/// 8-bit sRGB, row by row from the north-west.
struct MapImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
  std::vector<std::string> warnings;  ///< one line each; a missing font leaves the map without text
};

/// `result` must come from `tin`. Colours can be told apart by colour-blind readers and in grey print. Throws
/// InputError for a size out of range.
MapImage draw_map(const Tin& tin, const Result& result, const MapOptions& options = {});
/// The same over a surface; what of it has not been read is.
MapImage draw_map(Surface& surface, const Result& result, Progress& progress, const MapOptions& options = {});

/// Throws InputError if OpenImageIO knows no format for the path's ending (png, jpg, tif, ...).
void require_image_format(const std::string& path);

/// The file appears only when complete. Throws as require_image_format() does, and FileError if the place cannot be
/// written, or if the file exists and `overwrite` is false.
void write_image(const std::string& path, const MapImage& image, bool overwrite);

}  // namespace itin::viewshed
