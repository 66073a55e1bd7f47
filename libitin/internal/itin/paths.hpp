// Lines to follow, from any vector file.
//
//   for (const Path& path : read_paths("ridge.gpkg", store.metadata().crs_wkt)) ...
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <itin/geometry.hpp>

namespace itin {

struct Path {
  std::int64_t feature = 0;     ///< the file's own number for it
  std::string id;               ///< its `id` or `name` field, else its number
  std::string name;             ///< its `name` or `id` field; may be empty
  std::vector<Point2> corners;  ///< at least two, in the CRS asked for
};

/// Every line of every layer, in the file's order, in the CRS `to_crs` (WKT); a file that states no CRS is taken to be
/// in it. Features that are no lines are errors. Throws FileError for a file or feature that is missing or not
/// understood (naming it), InputError for a CRS that is unknown.
std::vector<Path> read_paths(const std::string& path, const std::string& to_crs);

/// How far along the path each corner is, horizontally: 0 at the first, the path's length at the last.
std::vector<double> distances_along(const std::vector<Point2>& corners);

}  // namespace itin
