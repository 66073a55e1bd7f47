// Layer styles, NAME.qml, which QGIS reads from beside a raster: classes by their names, and bands of values, in
// colours.
//
//   if (has_qgis_style(result.request.mode)) write_file("seen.qml", qgis_style(result), false);
#pragma once

#include <string>
#include <vector>

#include <itin/raster.hpp>
#include <viewshed/result.hpp>

namespace itin::viewshed {

/// Tells whether rasters of a mode have a style: those of classes, sets, counts, probabilities and losses. Angles,
/// heights and distances have none, for QGIS shades them from least to greatest by itself.
bool has_qgis_style(Mode mode);
/// The style of the raster that write_geotiff() writes of a result; empty where its mode has none. What first hides a
/// cell and which observers see it have entries for what occurs; of sets, for the commonest, by the first 32 observers.
std::string qgis_style(const Result& result);
/// The style of a raster of classes.
std::string qgis_style(const std::vector<RasterClass>& classes);
/// The style of the share that write_geotiff() writes of a VisibilityIndex.
std::string qgis_style_of_shares();

/// Returns the name of the style that is written beside a raster.
std::string style_beside(const std::string& raster);

}  // namespace itin::viewshed
