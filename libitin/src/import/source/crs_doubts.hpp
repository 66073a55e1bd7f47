// Doubts about a CRS that --crs gives to a source.
#pragma once

#include <string>
#include <vector>

#include <itin/geometry.hpp>

#include "gdal/crs.hpp"

namespace itin {

/// Returns warnings, each of which names both: where the CRS given takes the place of another one that the source
/// states and may well lie in, and where the source lies outside the area that the CRS given is made for. `extent` is
/// that of the source's coordinates as they stand in it.
std::vector<std::string> crs_doubts(const std::string& path, const Crs& crs, const Box& extent);

}  // namespace itin
