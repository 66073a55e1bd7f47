// The regions of a raster as a layer of a GeoPackage that has others.
//
//   styles.push_back(add_regions(package, layer));
#pragma once

#include <string>
#include <utility>

#include <itin/raster_regions.hpp>

#include "export/geopackage.hpp"

namespace itin {

/// Adds the layer as write_regions() writes it. Returns its name and its style, for add_layer_styles(). Throws
/// FileError.
std::pair<std::string, std::string> add_regions(GeoPackage& package, const RegionLayer& layer);

}  // namespace itin
