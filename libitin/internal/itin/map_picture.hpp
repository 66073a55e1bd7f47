// A georeferenced picture, a scanned or drawn map for instance, at the pixels of another grid.
//
//   const std::vector<Rgba> colours = picture_at("map.tif", pixels, store.metadata().crs_wkt);
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <itin/raster.hpp>

namespace itin {

/// The colours of a picture in grey, with a palette, or in red, green and blue, with or without alpha, of 8 bits each,
/// at these pixels of the CRS `crs_wkt`: averages where the picture is finer, clear beyond it. Throws FileError for a
/// file that is no such picture or states no CRS.
std::vector<Rgba> picture_at(const std::string& path, const RasterGrid& pixels, const std::string& crs_wkt);

}  // namespace itin
