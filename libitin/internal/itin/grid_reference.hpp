// References of the Ordnance Survey's National Grid, and of UTM.
#pragma once

#include <optional>
#include <string>

#include <itin/geometry.hpp>

namespace itin {

/// Tells whether a CRS (WKT) is the National Grid, EPSG:27700.
bool is_national_grid(const std::string& crs_wkt);

/// Returns "ST 10375 83525": the square of 100 km and then `figures` (1 to 5) of easting and of northing, cut, not
/// rounded, as is the practice. Nothing beyond the grid's squares.
std::optional<std::string> national_grid_reference(Point2 position, int figures = 5);

/// Returns the zone of UTM at a longitude and latitude, degrees; nothing near the poles.
std::optional<int> utm_zone_at(Point2 lon_lat);

/// Returns "UTM 30N 480100 5710100" for a longitude and latitude on WGS 84, rounded to metres; nothing near the poles.
std::optional<std::string> utm_reference(Point2 lon_lat);

}  // namespace itin
