// Layer styles, NAME.qml, which QGIS reads from beside a raster: bands of values in colours, where the raster itself
// can hold no colours.
//
//   if (const std::string style = qgis_style(request); !style.empty()) write_file("seen.qml", style, false);
#pragma once

#include <string>

#include <viewshed/request.hpp>

namespace itin::viewshed {

/// The style of the counts, probabilities or losses that answer the request. Empty for every other mode: classes have
/// their colours in the raster.
std::string qgis_style(const Request& request);
/// The style of the share that write_geotiff() writes of a VisibilityIndex.
std::string qgis_style_of_shares();

/// Returns the name of the style that is written beside a raster.
std::string style_beside(const std::string& raster);

}  // namespace itin::viewshed
