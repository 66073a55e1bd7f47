// A georeferenced picture, a scanned or drawn map for instance, at the pixels of another grid.
//
//   const std::vector<Rgba> colours = picture_at("map.tif", pixels, store.metadata().crs_wkt);
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <itin/raster.hpp>

namespace itin {

/// Returns the colours of a picture at these pixels of the CRS `crs_wkt`: averages where the picture is finer,
/// transparent beyond it. The picture is grey, with a palette, or red, green and blue, with or without alpha, of 8 bits
/// each. Throws FileError for a file that is no such picture or states no CRS.
std::vector<Rgba> picture_at(const std::string& path, const RasterGrid& pixels, const std::string& crs_wkt);

}  // namespace itin
