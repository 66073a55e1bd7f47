// Lines to follow, from any vector file.
//
//   for (const Path& path : read_paths("ridge.gpkg", store.metadata().crs_wkt, warnings)) ...
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <itin/geometry.hpp>

namespace itin {

struct Path {
  std::int64_t feature = 0;     ///< the file's own number for the feature
  std::string id;               ///< the feature's `id` or `name` field, else its number
  std::string name;             ///< the feature's `name` or `id` field; may be empty
  std::vector<Point2> corners;  ///< at least two, in the CRS asked for; a corner that is given again at once is one
  bool has_z = false;           ///< whether the file has a height for any corner that is not 0
};

/// A feature that is no line, or has a place that the CRS asked for does not know.
struct BadPath {
  std::size_t row = 0;  ///< the feature's place among all features of the file, from 1
  std::int64_t feature = 0;
  std::string id;  ///< as Path::id
  std::string message;
};

struct PathFile {
  std::vector<Path> paths;
  std::vector<BadPath> bad;           ///< in the file's order
  std::vector<std::string> warnings;  ///< about names that were not plain text, and CRSs not used; a line each
};

/// Which lines of a file are read: by default all lines of all layers.
struct PathChoice {
  std::string layer = {};  ///< the only layer to read; with `where` it may be empty if the file has but one
  std::string where = {};  ///< an attribute filter in OGR's SQL
  std::string crs = {};    ///< the CRS of a file that states none, or one that is not defined or cannot be its own
};

/// Returns the chosen lines, in the file's order, in the CRS `to_crs` (WKT); a file that states no CRS is taken to be
/// in that one. Throws FileError for a file, layer or field that is missing or not understood, InputError for a CRS
/// that is unknown, and a filter that makes no sense or leaves nothing.
PathFile read_path_file(const std::string& path, const std::string& to_crs, const PathChoice& choice = {});

/// Returns the lines alone, and adds to `warnings`. Throws as read_path_file() does, and FileError naming the first
/// feature that is no line.
std::vector<Path> read_paths(const std::string& path, const std::string& to_crs, std::vector<std::string>& warnings);

/// Returns the corners, each that equals the one before it left out; but two where all are equal.
std::vector<Point2> without_repeats(std::vector<Point2> corners);

/// Returns how far along the path each corner is, horizontally: 0 at the first, the path's length at the last.
std::vector<double> distances_along(const std::vector<Point2>& corners);

}  // namespace itin
