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

/// A CRS that was understood. Horizontal only: the vertical part of a compound CRS leaves but what its heights mean.
struct Crs {
  std::string wkt;                        ///< WKT 2; empty where there is but a vertical part
  std::string name;                       ///< "EPSG:27700" where an authority knows it, otherwise its name
  std::optional<double> metres_per_axis;  ///< metres in a unit of a projected CRS; nothing where its axes are angles
  std::optional<HeightAxis> heights;      ///< what the vertical part says, where there is one
  bool heights_given = false;             ///< `heights` come from --crs, whatever the source says itself
  std::string whole;                      ///< authority:code or WKT 2, vertical part included

  /// Projected, axes in metres: fit for a store.
  bool metric() const { return metres_per_axis == 1.0; }
};

/// `text` is authority:code, WKT, PROJ or whatever else GDAL understands. A CRS that agrees to a millimetre with one
/// that an authority knows is taken for that one. Throws InputError, which begins with `place` (a file or an option).
Crs parse_crs(const std::string& text, const std::string& place);
/// As parse_crs(), but the CRS may have a vertical part only.
Crs parse_any_crs(const std::string& text, const std::string& place);

/// The horizontal part, as parse_crs() takes it. Throws likewise.
OGRSpatialReference horizontal_crs(const std::string& text, const std::string& place);
/// Whether coordinates in both are the same: the one rule wherever something is compared with a store's CRS. Names,
/// codes, dialects and the order of axes do not matter. Both are of horizontal_crs().
bool same_crs(const OGRSpatialReference& a, const OGRSpatialReference& b);

/// WKT 2.
std::string wkt_of(const OGRSpatialReference& reference);

/// The UTM zone of a position in `crs`: of ETRS89 or NAD83 where that is the CRS's datum, otherwise of WGS 84. Throws
/// InputError where the position has no zone (a CRS without datum, the poles).
Crs utm_zone(const Crs& crs, Point2 position, const std::string& place);

/// How a source's coordinates become the store's. One thread at a time.
class PointTransform {
 public:
  /// The identity where both are the same_crs(). Throws InputError for what cannot be transformed.
  PointTransform(const std::string& source_wkt, const std::string& target_wkt, const std::string& place);
  PointTransform(PointTransform&&) noexcept;
  PointTransform& operator=(PointTransform&&) noexcept;
  ~PointTransform();

  bool identity() const { return !impl_; }
  /// In place; both coordinates of a point that cannot be transformed become NaN.
  void transform(std::span<double> x, std::span<double> y) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin
