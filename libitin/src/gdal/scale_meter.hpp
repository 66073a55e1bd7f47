// Measures the scale of one CRS at many places.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <itin/geodesic.hpp>
#include <itin/geometry.hpp>
#include <itin/grid_scale.hpp>

#include "gdal/crs.hpp"

namespace itin {

/// Measures the scale of one CRS. One thread at a time.
class ScaleMeter {
 public:
  /// Throws InputError unless the CRS has its axes in metres.
  explicit ScaleMeter(const Crs& crs);

  /// Returns the extremes over these places, in the CRS's coordinates; nothing where none of them is a place on the
  /// Earth.
  std::optional<GridScale> at(std::span<const Point2> places) const;
  /// Returns longitudes and latitudes, degrees; NaN where a place has no position on the Earth. Projections take
  /// numbers beyond the world for a place within it, so a place counts only if its longitude and latitude lead back to
  /// it.
  std::vector<Point2> lon_lat(std::span<const Point2> places) const;

 private:
  Ellipsoid ellipsoid_;
  double allowed_ = kGreatestScaleError;
  double degrees_ = 1;  ///< degrees per unit of the CRS's geographic CRS
  std::optional<PointTransform> to_geographic_, from_geographic_;
};

/// Returns the box's corners, its middle and places between them: five by five, all equal where the box is a point.
std::vector<Point2> places_in(const Box& area);

}  // namespace itin
