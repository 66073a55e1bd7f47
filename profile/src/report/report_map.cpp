// Puts the report on the map: KML for globes, layers for GeoPackage.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <itin/table_columns.hpp>
#include <profile/line_classes.hpp>
#include <profile/report_text.hpp>

#include "report/formats.hpp"
#include "report/kml.hpp"
#include "report/tables/tables.hpp"

namespace itin::profile {

namespace {

constexpr int kRayParts = 64, kZoneLines = 12;

/// The line's geometry in the store's CRS.
class Path {
 public:
  explicit Path(const LosReport& report) : report_(report) {
    const ProfilePoint &a = report.profile.points.front(), &b = report.profile.points.back();
    from_ = {a.x, a.y}, to_ = {b.x, b.y};
  }

  Point2 position(double d, double aside = 0) const {
    const double length = report_.profile.length_m, t = length > 0 ? d / length : 0;
    const double dx = to_.x - from_.x, dy = to_.y - from_.y;
    const double scale = length > 0 ? aside / length : 0;
    return {from_.x + dx * t + dy * scale, from_.y + dy * t - dx * scale};
  }
  /// The elevation above the datum: the ray is straight over the effective Earth, and its bulge is subtracted.
  double elevation(double d) const {
    return ray_elevation_m(report_, d) - report_.query.earth.drop_coefficient() * d * (report_.profile.length_m - d);
  }
  Point3 ray(double d, double aside = 0, double up = 0) const {
    const Point2 p = position(d, aside);
    return {p.x, p.y, elevation(d) + up};
  }
  std::vector<Point3> ray_line(double from, double to) const {
    std::vector<Point3> line;
    for (int i = 0; i <= kRayParts; ++i) line.push_back(ray(from + (to - from) * i / kRayParts));
    return line;
  }
  std::vector<Point3> ray_line() const { return ray_line(0, report_.profile.length_m); }
  /// Returns one line for each stretch of known ground.
  std::vector<std::vector<Point3>> ground_lines() const {
    const Profile& profile = report_.profile;
    std::vector<std::vector<Point3>> lines;
    for (std::size_t i = 0; i < profile.points.size(); ++i) {
      if (i == 0 || !profile.joined(i - 1)) lines.emplace_back();
      const ProfilePoint& p = profile.points[i];
      lines.back().push_back({p.x, p.y, p.ground_m});
    }
    std::erase_if(lines, [](const auto& line) { return line.size() < 2; });
    return lines;
  }
  std::vector<Point3> obstruction_line(const Obstruction& o) const {
    std::vector<Point3> line = {ray(o.from_m)};
    for (const ProfilePoint& p : report_.profile.points) {
      if (p.distance_m > o.from_m && p.distance_m < o.to_m) line.push_back({p.x, p.y, p.ground_m});
    }
    line.push_back(ray(o.to_m));
    return line;
  }
  /// A line along the surface of the first Fresnel zone, `angle` radians about the ray from the right.
  std::vector<Point3> zone_line(double angle) const {
    const double wavelength = wavelength_m(report_.query.radio->frequency_ghz), length = report_.profile.length_m;
    std::vector<Point3> line;
    for (int i = 0; i <= kRayParts; ++i) {
      const double d = length * (1 - std::cos(std::numbers::pi * i / kRayParts)) / 2;
      const double radius = fresnel_radius_m(d, length - d, wavelength);
      line.push_back(ray(d, radius * std::cos(angle), radius * std::sin(angle)));
    }
    return line;
  }

 private:
  const LosReport& report_;
  Point2 from_, to_;
};

Kml kml_of(const LosReport& report) {
  Kml kml(report.crs_wkt, report.title, verdict_line(report));
  kml.style("ray", kml_colour(class_of(report.verdict).colour), 3);
  kml.style("ground", "ff335577", 2);
  kml.style("cut", "ff0000ff", 5);
  kml.style("zone", "66e08040", 1);
  kml.style("gap", "ff909090", 5);
  return kml;
}

Point3 place_of(const ProfilePoint& p) {
  return {p.x, p.y, p.ground_m};
}

/// The points of a report's layer.
constexpr std::array<FeatureClass, 6> kPointClasses{{{"from", "First end", {20, 60, 140}},
                                                     {"to", "Second end", {86, 180, 233}},
                                                     {"critical", "Critical point", {208, 32, 32}},
                                                     {"reflection", "Reflection", {0, 158, 115}},
                                                     {"bullington", "Bullington's edge", {204, 121, 167}},
                                                     {"deygout", "Deygout's edge", {230, 159, 0}}}};

/// A point that maps name.
struct PointOfPath {
  std::string what;
  std::string name;
  double distance_m;
  std::optional<double> height_m;  ///< an end's height above what it stands on
  Point3 place;
};
/// The ends, the critical point, the point of reflection, and the edges of the losses.
std::vector<PointOfPath> path_points(const LosReport& report, const Path& path) {
  const double length = report.profile.length_m, from = report.query.from_height_m, to = report.query.to_height_m;
  std::vector<PointOfPath> points{{"from", fmt::format("{}, {:g} m", report.from_name, from), 0, from, path.ray(0)},
                                  {"to", fmt::format("{}, {:g} m", report.to_name, to), length, to, path.ray(length)}};
  if (const auto& p = report.critical)
    points.push_back({"critical", "Critical point, " + critical_line(report), p->distance_m, {}, place_of(*p)});
  const auto add = [&](const char* what, std::string name, double distance_m, double elevation_m) {
    const Point2 p = position_at(report, distance_m);
    points.push_back({what, std::move(name), distance_m, {}, {p.x, p.y, elevation_m}});
  };
  const std::optional<Reflection>& r = report.reflection;
  if (r && r->ground_m)
    add("reflection", "Reflection point, reflected path " + screen_text(report, unit_of(report)), r->distance_m,
        *r->ground_m);
  if (!report.losses) return points;
  const auto add_edge = [&](const char* what, const char* name, const DiffractionEdge& e) {
    add(what, fmt::format("{}, {:.2f} dB", name, e.loss_db), e.distance_m, e.elevation_m);
  };
  if (report.losses->bullington) add_edge("bullington", "Bullington's edge", *report.losses->bullington);
  for (const DiffractionEdge& e : report.losses->deygout) add_edge("deygout", "Deygout's edge", e);
  return points;
}

std::string gap_name(const LosReport& report, double from_m, double to_m) {
  return "No data, " + distance_text(to_m - from_m, unit_of(report));
}

std::string obstruction_name(const LosReport& report, const Obstruction& o) {
  return fmt::format("{}, {:.2f} m above the ray", cause_of(report, o.theme, o.feature), o.depth_m);
}

VectorLayer sight_line_layer(const LosReport& report) {
  using Row = const LosReport&;
  const std::vector<TableColumn<LosReport>> columns{
      {"verdict", [](Row r) { return name_of(r.verdict); }},
      {"distance_m", [](Row r) { return r.profile.length_m; }},
      {"clearance_m", &LosReport::clearance_m},
      {"fresnel_fraction", [](Row r) { return if_any(r.fresnel, &FresnelClearance::fraction); }},
      {"ld_db", [](Row r) { return if_any(r.losses, &PathLosses::ld_db); }},
      {"geodesic_distance_m", &LosReport::geodesic_m},
      {"gap_m", [](Row r) { return r.profile.gap_length_m(); }},
      {"known_verdict", [](Row r) { return name_of(r.known_verdict); }}};
  return layer_of(
      "sight_line", VectorLayer::Shape::kLines, columns, std::span(&report, 1),
      [](Row r) { return Path(r).ray_line(); }, line_style("verdict", kVerdictClasses, 0.8));
}

VectorLayer points_layer(const LosReport& report) {
  const std::vector<TableColumn<PointOfPath>> columns{
      {"what", &PointOfPath::what}, {"distance_m", &PointOfPath::distance_m}, {"height_m", &PointOfPath::height_m}};
  return layer_of(
      "points", VectorLayer::Shape::kPoints, columns, path_points(report, Path(report)),
      [](const PointOfPath& p) { return std::vector{p.place}; }, point_style("what", kPointClasses));
}

/// A column whose value is the same in all rows: that of the layer's only class.
template <class Row>
TableColumn<Row> what_column(const FeatureClass& only) {
  return {"what", [name = std::string(only.name)](const Row&) { return name; }};
}

VectorLayer ground_layer(const LosReport& report) {
  using Stretch = std::vector<Point3>;
  const std::vector<TableColumn<Stretch>> columns{what_column<Stretch>(kGroundClass[0]), {"points", &Stretch::size}};
  return layer_of(
      "ground", VectorLayer::Shape::kLines, columns, Path(report).ground_lines(),
      [](const Stretch& stretch) { return stretch; }, line_style("what", kGroundClass, 0.4));
}

VectorLayer obstructions_layer(const LosReport& report) {
  const std::vector<TableColumn<Obstruction>> columns{
      what_column<Obstruction>(kObstructionClass[0]),
      {"from_m", &Obstruction::from_m},
      {"to_m", &Obstruction::to_m},
      {"peak_at_m", &Obstruction::peak_at_m},
      {"depth_m", &Obstruction::depth_m},
      {"cause", [&](const Obstruction& o) { return cause_of(report, o.theme, o.feature); }}};
  const Path path(report);
  return layer_of(
      "obstructions", VectorLayer::Shape::kLines, columns, report.obstructions,
      [&](const Obstruction& o) { return path.obstruction_line(o); }, line_style("what", kObstructionClass, 1.6));
}

VectorLayer gaps_layer(const LosReport& report) {
  using Gap = std::pair<double, double>;
  const std::vector<TableColumn<Gap>> columns{
      what_column<Gap>(kGapClass[0]), {"from_m", &Gap::first}, {"to_m", &Gap::second}};
  const Path path(report);
  return layer_of(
      "gaps", VectorLayer::Shape::kLines, columns, report.profile.gaps,
      [&](const Gap& gap) { return path.ray_line(gap.first, gap.second); }, line_style("what", kGapClass, 1.6));
}

}  // namespace

std::string report_kml(const LosReport& report) {
  const Path path(report);
  const double length = report.profile.length_m;
  Kml kml = kml_of(report);
  for (const PointOfPath& p : path_points(report, path)) kml.point(p.name, p.place);
  kml.line("Ray", "ray", path.ray_line());
  for (const std::vector<Point3>& line : path.ground_lines()) kml.line("Ground", "ground", line);
  for (const Obstruction& o : report.obstructions) {
    kml.line(obstruction_name(report, o), "cut", path.obstruction_line(o));
  }
  for (const auto& [from, to] : report.profile.gaps)
    kml.line(gap_name(report, from, to), "gap", path.ray_line(from, to));
  if (report.query.radio && length > 0) {
    kml.open_folder("First Fresnel zone");
    for (int i = 0; i < kZoneLines; ++i) {
      kml.line("F1", "zone", path.zone_line(2 * std::numbers::pi * i / kZoneLines));
    }
    kml.close_folder();
  }
  return kml.finish();
}

std::vector<VectorLayer> report_layers(const LosReport& report) {
  return {sight_line_layer(report), points_layer(report), ground_layer(report), obstructions_layer(report),
          gaps_layer(report)};
}

}  // namespace itin::profile
