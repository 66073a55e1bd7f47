#include <cmath>
#include <memory>

#include <ogr_spatialref.h>

#include <itin/celestial_body.hpp>

#include "gdal/crs.hpp"
#include "gdal/files/quiet_gdal.hpp"

namespace itin {

bool is_of_earth(const Ellipsoid& ellipsoid) {
  constexpr double kShare = 0.005;  // all ellipsoids and spheres of the Earth differ by less
  return std::abs(ellipsoid.major_m - kWgs84.major_m) < kShare * kWgs84.major_m;
}

CelestialBody body_of(const std::string& wkt) {
  const auto ellipsoid = ellipsoid_in(wkt);
  if (!ellipsoid || is_of_earth(*ellipsoid)) return {};
  const QuietGdal quiet;
  const std::unique_ptr<OGRSpatialReference> geographic(horizontal_crs(wkt, "CRS").CloneGeogCS());
  return {*ellipsoid, wkt_of(*geographic), false};
}

}  // namespace itin
