// QGIS's style of regions, each class in its colour, kept within the GeoPackage.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <gdal_priv.h>

#include <itin/raster_regions.hpp>

namespace itin {

/// Returns QGIS's own style of a layer of polygons with a field `value`.
std::string polygon_style(const std::vector<RegionClass>& classes);

/// Adds the table `layer_styles`, from which QGIS takes a layer's style as it opens, with these layers and their
/// styles. Returns whether that worked.
bool add_layer_styles(GDALDataset& geopackage, const std::vector<std::pair<std::string, std::string>>& styles);

}  // namespace itin
