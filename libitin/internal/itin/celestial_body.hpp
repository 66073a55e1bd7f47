// The body that a CRS is of: the Earth, the Moon, Mars.
//
//   const CelestialBody body = body_of(store.metadata().crs_wkt);
//   CoordinateTransform to_lon_lat(store.metadata().crs_wkt, body.geographic_crs);
#pragma once

#include <optional>
#include <string>

#include <itin/geodesic.hpp>

namespace itin {

struct CelestialBody {
  Ellipsoid ellipsoid = kWgs84;
  std::string geographic_crs = "EPSG:4326";  ///< CRS of longitudes and latitudes in degrees
  bool is_earth = true;

  /// The mean of the three half axes, metres.
  double mean_radius_m() const { return ellipsoid.major_m * (3 - ellipsoid.flattening) / 3; }
};

/// Tells by the size of an ellipsoid whether it is one of the Earth's.
bool is_of_earth(const Ellipsoid& ellipsoid);

/// Returns the ellipsoid that stands in WKT 2.
std::optional<Ellipsoid> ellipsoid_in(const std::string& wkt);

/// Returns the body of a CRS, given as WKT 2; the Earth where it does not say.
CelestialBody body_of(const std::string& wkt);

}  // namespace itin
