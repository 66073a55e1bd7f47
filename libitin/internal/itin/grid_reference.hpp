// References of the Ordnance Survey's National Grid.
#pragma once

#include <optional>
#include <string>

#include <itin/geometry.hpp>

namespace itin {

/// Whether a CRS (WKT) is the National Grid, EPSG:27700.
bool is_national_grid(const std::string& crs_wkt);

/// "ST 10375 83525": the square of 100 km and then `figures` (1 to 5) of easting and of northing, cut, not rounded, as
/// is the practice. Nothing beyond the grid's squares.
std::optional<std::string> national_grid_reference(Point2 position, int figures = 5);

}  // namespace itin
