// A surface seen from afar and above: parallel projection, shaded, what stands on it in a colour a theme.
//
//   viewshed::MapImage view = viewshed::draw_oblique(tin, {.azimuth = 340, .elevation = 40});
//   viewshed::write_image("town.png", view, overwrite);
#pragma once

#include <itin/tin.hpp>
#include <viewshed/map_image.hpp>

namespace itin::viewshed {

struct ObliqueOptions {
  double azimuth = 340;   ///< degrees clockwise from grid north: where the viewer looks
  double elevation = 40;  ///< degrees, above 0 up to 90: how high above the horizon the viewer is
  int pixels = 1600;      ///< of the picture's longer side, 200 to 16000
};

/// Hidden parts are hidden exactly, up to a pixel. O(n) time for n triangles and O(pixels^2) memory, on one thread.
/// Throws InputError for options out of range and for a surface without triangles.
MapImage draw_oblique(const Tin& tin, const ObliqueOptions& options = {});

}  // namespace itin::viewshed
