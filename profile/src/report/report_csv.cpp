#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include <itin/celestial_body.hpp>
#include <itin/coordinates.hpp>

#include "report/formats.hpp"

namespace itin::profile {

namespace {

std::string digits(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "";
}

/// The metres without data between a point and the next one.
double gap_behind(const Profile& profile, std::size_t i) {
  if (i + 1 == profile.points.size() || profile.joined(i)) return 0;
  return profile.points[i + 1].distance_m - profile.points[i].distance_m;
}

/// The mark of a point beyond a gap, in the classes of rasters: 0 hidden, 1 visible, 2 undecided.
char seen_beyond(NoData rule) {
  return rule == NoData::kUnknown ? '2' : rule == NoData::kBlock ? '0' : '1';
}

}  // namespace

std::string report_csv(const LosReport& report) {
  std::optional<CoordinateTransform> to_geographic;
  if (!report.crs_wkt.empty()) to_geographic.emplace(report.crs_wkt, body_of(report.crs_wkt).geographic_crs);
  const double length = report.profile.length_m, drop = report.query.earth.drop_coefficient();
  const double wavelength = report.query.radio ? wavelength_m(report.query.radio->frequency_ghz) : 0;
  std::string csv =
      "distance_m,x,y,lon,lat,ground_m,feature_top_m,bulge_m,ray_m,f1_m,clearance_m,clearance_f1,v,visible,"
      "theme,gap_m\n";
  char beyond_gaps = '1';  // the mark of a point that no known ground hides
  double steepest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < report.profile.points.size(); ++i) {
    const ProfilePoint& p = report.profile.points[i];
    const double d = p.distance_m, bulge = drop * d * (length - d), ray = ray_elevation_m(report, d);
    const double clearance = ray - p.ground_m - bulge, radius = fresnel_radius_m(d, length - d, wavelength);
    // A point is seen from the first end where no ground before it rises higher.
    const double slope = d > 0 ? (p.ground_m - report.antennas.from_m) / d - drop * d : steepest;
    const bool visible = slope >= steepest;
    const double gap = gap_behind(report.profile, i);
    steepest = std::max(steepest, slope);
    csv += digits(d, 3) + ",";
    if (to_geographic) {
      const Point2 lon_lat = (*to_geographic)({p.x, p.y});
      csv += fmt::format("{:.3f},{:.3f},{:.8f},{:.8f},", p.x, p.y, lon_lat.x, lon_lat.y);
    } else {
      csv += ",,,,";
    }
    csv += digits(height_at(report.ground, d).value_or(p.ground_m), 3) + "," + digits(p.ground_m + p.clutter_m, 3) +
           "," + digits(bulge, 3) + "," + digits(ray, 3) + ",";
    csv += wavelength > 0 ? digits(radius, 3) : "";
    csv += "," + digits(clearance, 3) + ",";
    if (radius > 0)
      csv += digits(clearance / radius, 4) + "," + digits(-std::sqrt(2.0) * clearance / radius, 4);
    else
      csv += ",";
    csv += fmt::format(",{},{},{}\n", visible ? beyond_gaps : '0', cause_of(report, p.theme), digits(gap, 3));
    if (gap > 0) beyond_gaps = seen_beyond(report.query.nodata);
  }
  return csv;
}

}  // namespace itin::profile
