#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <itin/celestial_body.hpp>
#include <itin/coordinates.hpp>
#include <itin/table_columns.hpp>

#include "report/formats.hpp"

namespace itin::profile {

namespace {

/// A point of the profile, and the sight line above it.
struct PathPoint {
  ProfilePoint point;
  std::optional<Point2> lon_lat;  ///< nothing without a CRS
  double ground_m = 0;            ///< the bare ground
  double bulge_m = 0;             ///< the Earth's
  double ray_m = 0, clearance_m = 0;
  std::optional<double> f1_m;  ///< the radius of the first Fresnel zone; nothing without a frequency
  char visible = '1';          ///< from the first end, in the classes of rasters
  std::string cause;
  double gap_m = 0;  ///< without data, up to the next point

  /// The clearance in radii of the first Fresnel zone; nothing where it has none.
  std::optional<double> clearance_f1() const {
    return f1_m && *f1_m > 0 ? std::optional(clearance_m / *f1_m) : std::nullopt;
  }
  std::optional<double> v() const {
    const std::optional<double> fraction = clearance_f1();
    return fraction ? std::optional(-std::sqrt(2.0) * *fraction) : std::nullopt;
  }
};

/// The metres without data between a point and the next one.
double gap_behind(const Profile& profile, std::size_t i) {
  if (i + 1 == profile.points.size() || profile.joined(i)) return 0;
  return profile.points[i + 1].distance_m - profile.points[i].distance_m;
}

/// The mark of a point beyond a gap, in the classes of rasters: 0 hidden, 1 visible, 2 undecided.
char seen_beyond(NoData rule) {
  return rule == NoData::kUnknown ? '2' : rule == NoData::kBlock ? '0' : '1';
}

std::vector<PathPoint> rows_of_path(const LosReport& report) {
  std::optional<CoordinateTransform> to_geographic;
  if (!report.crs_wkt.empty()) to_geographic.emplace(report.crs_wkt, body_of(report.crs_wkt).geographic_crs);
  const double length = report.profile.length_m, drop = report.query.earth.drop_coefficient();
  const std::optional<RadioPath>& radio = report.query.radio;
  char beyond_gaps = '1';  // the mark of a point that no known ground hides
  double steepest = -std::numeric_limits<double>::infinity();
  std::vector<PathPoint> points;
  for (std::size_t i = 0; i < report.profile.points.size(); ++i) {
    const ProfilePoint& p = report.profile.points[i];
    const double d = p.distance_m;
    PathPoint& row = points.emplace_back(PathPoint{.point = p});
    if (to_geographic) row.lon_lat = (*to_geographic)({p.x, p.y});
    row.ground_m = height_at(report.ground, d).value_or(p.ground_m);
    row.bulge_m = drop * d * (length - d);
    row.ray_m = ray_elevation_m(report, d);
    row.clearance_m = row.ray_m - p.ground_m - row.bulge_m;
    if (radio) row.f1_m = fresnel_radius_m(d, length - d, wavelength_m(radio->frequency_ghz));
    // A point is seen from the first end where no ground before it rises higher.
    const double slope = d > 0 ? (p.ground_m - report.antennas.from_m) / d - drop * d : steepest;
    row.visible = slope >= steepest ? beyond_gaps : '0';
    row.cause = cause_of(report, p.theme);
    row.gap_m = gap_behind(report.profile, i);
    steepest = std::max(steepest, slope);
    if (row.gap_m > 0) beyond_gaps = seen_beyond(report.query.nodata);
  }
  return points;
}

std::vector<TableColumn<PathPoint>> columns_of(const LosReport& report) {
  using Row = const PathPoint&;
  const auto placed = [known = !report.crs_wkt.empty()](double value) {
    return known ? std::optional(value) : std::nullopt;
  };
  return {{"distance_m", [](Row r) { return r.point.distance_m; }, kInCsv, "{:.3f}"},
          {"x", [placed](Row r) { return placed(r.point.x); }, kInCsv, "{:.3f}"},
          {"y", [placed](Row r) { return placed(r.point.y); }, kInCsv, "{:.3f}"},
          {"lon", [](Row r) { return if_any(r.lon_lat, &Point2::x); }, kInCsv, "{:.8f}"},
          {"lat", [](Row r) { return if_any(r.lon_lat, &Point2::y); }, kInCsv, "{:.8f}"},
          {"ground_m", &PathPoint::ground_m, kInCsv, "{:.3f}"},
          {"feature_top_m", [](Row r) { return r.point.ground_m + r.point.clutter_m; }, kInCsv, "{:.3f}"},
          {"bulge_m", &PathPoint::bulge_m, kInCsv, "{:.3f}"},
          {"ray_m", &PathPoint::ray_m, kInCsv, "{:.3f}"},
          {"f1_m", &PathPoint::f1_m, kInCsv, "{:.3f}"},
          {"clearance_m", &PathPoint::clearance_m, kInCsv, "{:.3f}"},
          {"clearance_f1", &PathPoint::clearance_f1, kInCsv, "{:.4f}"},
          {"v", &PathPoint::v, kInCsv, "{:.4f}"},
          {"visible", [](Row r) { return std::string(1, r.visible); }, kInCsv},
          {"theme", &PathPoint::cause, kInCsv},
          {"gap_m", &PathPoint::gap_m, kInCsv, "{:.3f}"}};
}

}  // namespace

std::string report_csv(const LosReport& report) {
  return csv_of(columns_of(report), rows_of_path(report));
}

}  // namespace itin::profile
