// The ground under a map: its heights and shades at the pixels of a picture.
//
//   const Relief ground = relief(store, RasterGrid::aligned(box, 25), progress);
#pragma once

#include <vector>

#include <itin/progress.hpp>
#include <itin/raster.hpp>
#include <itin/store.hpp>

namespace itin::viewshed {

/// Heights and shades of the ground at the pixels; NaN where there is no ground.
struct Relief {
  RasterGrid pixels;
  std::vector<float> heights_m;
  std::vector<float> shades;  ///< 0 (darkest) to 1, kLevelShade where it is level
};

/// The shade of level ground.
inline constexpr double kLevelShade = 0.643;

/// Returns the heights of the ground at the pixels, metres; NaN where there is none. They are those of the coarsest
/// level within the tolerance, or of a coarser one that has at most about 1.5 million points there. Throws what
/// triangulate() throws.
std::vector<float> ground_heights(const Store& store, const RasterGrid& pixels, double tolerance, Progress& progress);

/// Reads the coarsest level that cannot be told from the full terrain at the size of a pixel, at most about 1.5 million
/// points. Throws what triangulate() throws.
Relief relief(const Store& store, const RasterGrid& pixels, Progress& progress);

}  // namespace itin::viewshed
