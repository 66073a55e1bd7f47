// Coordinate reference systems of sources and stores, as far as import needs them. Axes are always easting, northing
// (or longitude, latitude), whatever the CRS's authority says.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include <itin/geometry.hpp>
#include <itin/height_axis.hpp>

class OGRSpatialReference;

namespace itin {

/// A CRS that was understood. It is horizontal only: of a compound CRS's vertical part, only the meaning of heights is
/// kept.
struct Crs {
  std::string wkt;                        ///< WKT 2; empty where there is only a vertical part
  std::string name;                       ///< "EPSG:27700" where an authority knows the CRS, otherwise its own name
  std::optional<double> metres_per_axis;  ///< metres per unit of a projected CRS; nothing where its axes are angles
  std::optional<HeightAxis> heights;      ///< the heights of the vertical part, where there is one
  bool given = false;                     ///< the horizontal part comes from --crs
  std::string overridden;                 ///< WKT of the CRS that the source states, where --crs gives another one
  bool heights_given = false;             ///< `heights` come from --crs, whatever the source itself says
  std::string whole;                      ///< authority:code or WKT 2, vertical part included

  bool east_north = true;  ///< the axes of a projected CRS run to the east and to the north, or at a pole

  /// Tells whether the CRS is projected with axes in metres.
  bool metric() const { return metres_per_axis == 1.0; }
  /// Tells whether it may be a store's. Azimuths, wedges and north arrows count on axes to the east and to the north.
  bool fits_store() const { return metric() && east_north; }
};

/// Reads `text`: authority:code, WKT, PROJ or whatever else GDAL understands. A CRS that agrees to a millimetre with
/// one that an authority knows is taken for that one. Throws InputError, which begins with `place` (a file or an
/// option).
Crs parse_crs(const std::string& text, const std::string& place);
/// Does what parse_crs() does, but the CRS may have a vertical part only.
Crs parse_any_crs(const std::string& text, const std::string& place);

/// Returns the horizontal part, as parse_crs() takes it. Throws as parse_crs() does.
OGRSpatialReference horizontal_crs(const std::string& text, const std::string& place);
/// Tells whether coordinates in both are the same: the one rule wherever something is compared with a store's CRS.
/// Names, codes, dialects and the order of axes do not matter. Precondition: both come from horizontal_crs().
bool same_crs(const OGRSpatialReference& a, const OGRSpatialReference& b);

/// Returns WKT 2.
std::string wkt_of(const OGRSpatialReference& reference);

/// Returns the UTM zone of a position in `crs`: of ETRS89 or NAD83 where that is the CRS's datum, otherwise of WGS 84.
/// Throws InputError where the position has no zone (a CRS without datum, the poles).
Crs utm_zone(const Crs& crs, Point2 position, const std::string& place);

/// Turns a source's coordinates into the store's. One thread at a time.
class PointTransform {
 public:
  /// Makes the identity where both are the same_crs(). Throws InputError for CRSs without a transformation between
  /// them.
  PointTransform(const std::string& source_wkt, const std::string& target_wkt, const std::string& place);
  PointTransform(PointTransform&&) noexcept;
  PointTransform& operator=(PointTransform&&) noexcept;
  ~PointTransform();

  bool identity() const { return !impl_; }
  /// Transforms in place; both coordinates of a point that cannot be transformed become NaN.
  void transform(std::span<double> x, std::span<double> y) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin
