// A CRS in the words of messages and reports.
#pragma once

#include <string>

namespace itin {

/// The CRS in few words: its authority's code, or else its name.
std::string crs_in_short(const std::string& wkt);
/// The CRS by its name and, where an authority has given it one, its code: "OSGB36 / British National Grid
/// (EPSG:27700)".
std::string crs_in_full(const std::string& wkt);

}  // namespace itin
