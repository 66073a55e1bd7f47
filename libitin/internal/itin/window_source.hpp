// Windows from well-known text or from a vector file.
//
//   Window a = window_from_polygon("POLYGON ((0 0, 10 0, 10 10, 0 0))");
//   Window b = window_from_polygon("parish.gpkg", store.metadata().crs_wkt);
#pragma once

#include <string>

#include <itin/window.hpp>

namespace itin {

/// Reads `wkt_or_file`: a polygon, multipolygon or collection of them as well-known text, or the name of a vector file
/// that GDAL reads. For a file, it takes all polygons of all layers together. Curves are cut into chords.
///
/// Coordinates of a file are taken from its CRS to `target_crs` (WKT or authority:code), corner by corner: edges stay
/// straight. Where either CRS is unknown, coordinates are used as they are. `wkt_crs` is the CRS of text; by default
/// text is in the target's CRS. Axes are easting, northing (or longitude, latitude), whatever the CRS's authority says.
///
/// Throws InputError (malformed text, no polygon, not a shape, cannot be transformed), FileError (missing, unreadable).
Window window_from_polygon(const std::string& wkt_or_file, const std::string& target_crs = {},
                           const std::string& wkt_crs = {});

}  // namespace itin
