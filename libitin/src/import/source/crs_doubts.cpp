#include "import/source/crs_doubts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <itin/error.hpp>

#include "gdal/files/quiet_gdal.hpp"
#include "gdal/scale_meter.hpp"

namespace itin {

namespace {

/// How far beyond its area of use, in degrees, a CRS is used without a doubt.
constexpr double kMargin = 0.5;

/// Whether coordinates may be in a CRS: GDAL takes all GeoJSON for degrees, whatever stands in it.
bool may_lie_in(const Crs& crs, const Box& extent) {
  return crs.metres_per_axis || (extent.xmin >= -360 && extent.xmax <= 360 && extent.ymin >= -90 && extent.ymax <= 90);
}

struct AreaOfUse {
  double west = 0, south = 0, east = 0, north = 0;
  std::string name;

  bool holds(Point2 lon_lat) const {
    const double width = (east < west ? 360 : 0) + east - west, from_west = lon_lat.x - west;
    const double turned = from_west - 360 * std::floor((from_west + kMargin) / 360);
    return turned <= width + kMargin && lon_lat.y >= south - kMargin && lon_lat.y <= north + kMargin;
  }
};

std::optional<AreaOfUse> area_of_use(const Crs& crs, const std::string& path) {
  AreaOfUse area;
  const char* name = nullptr;
  const OGRSpatialReference reference = horizontal_crs(crs.wkt, path);
  if (!reference.GetAreaOfUse(&area.west, &area.south, &area.east, &area.north, &name)) return std::nullopt;
  area.name = name != nullptr ? name : "";
  return area;
}

/// Returns the longitudes and latitudes of places in the extent that have some; none for a CRS of another body.
std::vector<Point2> lon_lats(const Crs& crs, const Box& extent, const std::string& path) {
  std::vector<Point2> places;
  try {
    const PointTransform transform(crs.wkt, "EPSG:4326", path);
    for (Point2 p : places_in(extent)) {
      transform.transform(std::span(&p.x, 1), std::span(&p.y, 1));
      if (std::isfinite(p.x) && std::isfinite(p.y)) places.push_back(p);
    }
  } catch (const InputError&) {
    return {};
  }
  return places;
}

}  // namespace

std::vector<std::string> crs_doubts(const std::string& path, const Crs& crs, const Box& extent) {
  if (!crs.given) return {};
  const QuietGdal quiet;
  std::vector<std::string> doubts;
  if (const Crs own = crs.overridden.empty() ? Crs{} : parse_crs(crs.overridden, path);
      !own.wkt.empty() && may_lie_in(own, extent))
    doubts.push_back(
        fmt::format("{}: `crs` {} takes the place of {}, which the file states; leave it out if the file is "
                    "right",
                    path, crs.name, own.name));
  const std::optional<AreaOfUse> area = area_of_use(crs, path);
  const std::vector<Point2> places = area ? lon_lats(crs, extent, path) : std::vector<Point2>{};
  if (!places.empty() && std::none_of(places.begin(), places.end(), [&](Point2 p) { return area->holds(p); }))
    doubts.push_back(
        fmt::format("{}: lies at longitude {:.4f}, latitude {:.4f} in `crs` {}, outside the area that this "
                    "is made for: {}",
                    path, places[places.size() / 2].x, places[places.size() / 2].y, crs.name, area->name));
  return doubts;
}

}  // namespace itin
