// `--in-crs`: points given in another coordinate reference system than the store's.
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include <itin/geometry.hpp>

#include "program/values.hpp"

namespace itin::cli {

struct InCrs {
  std::string crs;  ///< empty: the store's

  void declare(CLI::App& app);
  /// The CRS option for a place that may state its CRS itself.
  InCrs of(const Place& place) const { return place.crs.empty() ? *this : InCrs{place.crs}; }
  /// Returns a function that takes points to the CRS `wkt`. Throws InputError for an unknown CRS; the function throws
  /// it for a point that has no place in that CRS.
  std::function<Point2(Point2)> transform_to(const std::string& wkt) const;
};

}  // namespace itin::cli
