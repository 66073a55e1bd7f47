// Coordinate reference systems by name, points from one to another, and how true lengths are on a CRS's grid.
//
//   CoordinateTransform to_store("EPSG:4326", store.metadata().crs_wkt);
//   const Point2 cardiff = to_store({-3.18, 51.48});  // longitude, latitude
//
// Axis order is the one of maps and files, whatever the authority says: easting, northing; longitude, latitude.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <itin/geometry.hpp>

namespace itin {

/// Takes points from one CRS to another. Not thread-safe; make one per thread.
class CoordinateTransform {
 public:
  /// Takes CRSs as authority:code, WKT, PROJ string or anything else GDAL understands. Where both are one by the
  /// import's rule, the transformation is the identity. Throws InputError for a CRS that is unknown or for a pair
  /// without a transformation between them.
  CoordinateTransform(const std::string& from_crs, const std::string& to_crs);
  CoordinateTransform(CoordinateTransform&&) noexcept;
  CoordinateTransform& operator=(CoordinateTransform&&) noexcept;
  ~CoordinateTransform();

  /// Returns the point in the other CRS. Throws InputError for a point outside the transformation's domain.
  Point2 operator()(Point2 p) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Returns the authority's code of the CRS, "EPSG:27700" say, or the WKT itself where it has none.
std::string crs_identifier(const std::string& wkt);

/// The name that people use for a CRS: "OSGB36 / British National Grid".
std::string crs_title(const std::string& wkt);

/// The greatest errors of lengths with which an import takes a CRS for a store: in general, and in a CRS about the
/// equator.
inline constexpr double kGreatestScaleError = 0.005, kGreatestScaleErrorOfWorld = 0.002;

/// Ratios of the distance on the grid to the geodesic one on the CRS's own ellipsoid, for short lines in any direction.
struct GridScale {
  double least = 1, greatest = 1;
  double allowed = kGreatestScaleError;  ///< greatest error that is accepted in this CRS

  double error() const { return std::max(std::abs(least - 1), std::abs(greatest - 1)); }
  bool is_true() const { return error() <= allowed; }
};

}  // namespace itin
