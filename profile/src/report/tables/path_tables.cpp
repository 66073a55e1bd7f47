#include "report/tables/path_tables.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/geodesic.hpp>
#include <profile/report_text.hpp>

#include "drawing/axis.hpp"
#include "lines/paths/path_cover.hpp"

namespace itin::profile {

namespace {

/// The rows at the table's own spacing where the report leaves that open; they leave room on a page for named places.
constexpr int kUsualRows = 30;
constexpr double kMostRows = 10000;
/// Places nearer to each other than this, in metres, share one row: no digit tells them apart.
constexpr double kOneRow = 0.05;

std::string share_text(double part, double whole) {
  return fmt::format("{:.1f} %", whole > 0 ? 100 * part / whole : 0);
}

Table cover_table(const LosReport& report, const std::vector<ThemeLength>& cover) {
  const double length = report.profile.length_m, gap = report.profile.gap_length_m();
  const DistanceUnit unit = unit_of(report);
  Table table{"What the path crosses", {"over", "length", "of the path"}, {}, ""};
  for (const ThemeLength& part : cover)
    table.rows.push_back({part.theme == 0 ? "ground on which nothing stands" : cause_of(report, part.theme),
                          distance_text(part.length_m, unit), share_text(part.length_m, length)});
  if (gap > 0) table.rows.push_back({"ground without data", distance_text(gap, unit), share_text(gap, length)});
  return table;
}

std::vector<std::string> edge_row(const char* what, const DiffractionEdge& edge, DistanceUnit unit) {
  return {what, distance_text(edge.distance_m, unit), fmt::format("{:.2f} m", edge.elevation_m),
          fmt::format("{:.3f}", edge.v), fmt::format("{:.2f} dB", edge.loss_db)};
}

Table edges_table(const PathLosses& losses, DistanceUnit unit) {
  Table table{"Diffraction edges", {"edge", "at", "elevation", "v", "J(v)"}, {}, "", true};
  if (losses.bullington) table.rows.push_back(edge_row("Bullington's", *losses.bullington, unit));
  for (std::size_t i = 0; i < losses.deygout.size(); ++i)
    table.rows.push_back(edge_row(i == 0 ? "Deygout's main edge" : "Deygout's, beside it", losses.deygout[i], unit));
  table.note =
      "Bullington's edge stands for the whole terrain: where the lines to the two horizons meet or, within sight, the "
      "point of the largest v. The delta-Bullington loss is worked out from it.";
  return table;
}

Table reflection_table(const LosReport& report) {
  const Reflection& r = *report.reflection;
  Table table{"Reflection point", {}, {}, "", true};
  table.rows = {
      {"Distance from A", distance_text(r.distance_m, unit_of(report))},
      {"Grazing angle", fmt::format("{:.3f}\xC2\xB0", r.grazing_deg)},
      {"Reflected path is longer by", fmt::format("{:.3f} m, {:.2f} wavelengths", r.longer_by_m,
                                                  r.longer_by_m / wavelength_m(report.query.radio->frequency_ghz))}};
  if (r.ground_m)
    table.rows.push_back({"Elevation there", fmt::format("{:.2f} m, {}", *r.ground_m, cause_of(report, r.theme))});
  table.rows.push_back({"Reflected path", screen_text(report, unit_of(report))});
  table.note =
      "On the straight surface that fits the ground best (P.452 attachment 2, 5.1.6), over the effective Earth, where "
      "the angles of incidence and reflection are equal. The reflected path runs to what stands there.";
  return table;
}

/// A place on the line, and its name in the report; the name is empty at the table's own spacing.
struct NamedPlace {
  double distance_m = 0;
  std::string name;
};

std::vector<NamedPlace> named_places(const LosReport& report) {
  std::vector<NamedPlace> places = {{0, "A"}, {report.profile.length_m, "B"}};
  if (report.critical) places.push_back({report.critical->distance_m, "critical point"});
  for (const Obstruction& o : report.obstructions) places.push_back({o.peak_at_m, "obstruction"});
  if (report.fresnel) places.push_back({report.fresnel->distance_m, "least clearance / F1"});
  if (report.reflection) places.push_back({report.reflection->distance_m, "reflection"});
  if (!report.losses) return places;
  if (report.losses->bullington) places.push_back({report.losses->bullington->distance_m, "Bullington's edge"});
  for (const DiffractionEdge& edge : report.losses->deygout) places.push_back({edge.distance_m, "Deygout's edge"});
  return places;
}

/// The spacing as asked for, or 1, 2 or 5 times a power of ten that divides the length into at most kUsualRows.
double spacing_of(const LosReport& report) {
  const double length = report.profile.length_m,
               spacing = report.table_spacing_m.value_or(Axis{0, length}.step(kUsualRows));
  if (!(spacing > 0) || length / spacing > kMostRows)
    throw InputError(fmt::format("`table_spacing_m` {:g}: over {:.1f} m it must be at least {:g}", spacing, length,
                                 length / kMostRows),
                     "table_spacing_m");
  return spacing;
}

/// Returns the places in order, where the names of one place are joined.
std::vector<NamedPlace> places_at(const LosReport& report, double spacing) {
  std::vector<NamedPlace> all = named_places(report);
  for (int i = 1; i * spacing < report.profile.length_m; ++i) all.push_back({i * spacing, ""});
  std::stable_sort(all.begin(), all.end(),
                   [](const NamedPlace& a, const NamedPlace& b) { return a.distance_m < b.distance_m; });
  std::vector<NamedPlace> places;
  for (const NamedPlace& place : all) {
    if (places.empty() || place.distance_m - places.back().distance_m > kOneRow) {
      places.push_back(place);
    } else if (!place.name.empty() && places.back().name.find(place.name) == std::string::npos) {
      NamedPlace& before = places.back();
      if (before.name.empty()) before.distance_m = place.distance_m;
      before.name += (before.name.empty() ? "" : ", ") + place.name;
    }
  }
  return places;
}

/// A distance without its unit.
std::string number_text(double metres, DistanceUnit unit) {
  const std::string text = distance_text(metres, unit);
  return text.substr(0, text.find(' '));
}

std::vector<std::string> profile_row(const LosReport& report, const NamedPlace& place) {
  const double d = place.distance_m, rest = report.profile.length_m - d;
  const auto metres = [](double value) { return fmt::format("{:.2f}", value); };
  const double bulge = report.query.earth.drop_coefficient() * d * rest, line = ray_elevation_m(report, d);
  const std::optional<double> top = height_at(report.profile, d);
  const std::optional<double> ground = report.ground.points.empty() ? top : height_at(report.ground, d);
  const double radius =
      report.query.radio ? fresnel_radius_m(d, rest, wavelength_m(report.query.radio->frequency_ghz)) : 0;
  std::vector<std::string> cells = {number_text(d, unit_of(report)), ground ? metres(*ground) : "no data",
                                    top ? metres(*top) : "no data", metres(bulge), metres(line)};
  const std::optional<double> clearance = top ? std::optional(line - *top - bulge) : std::nullopt;
  if (report.query.radio) cells.push_back(metres(radius));
  cells.push_back(clearance ? metres(*clearance) : "");
  if (report.query.radio) cells.push_back(clearance && radius > 0 ? metres(*clearance / radius) : "");
  cells.push_back(place.name);
  return cells;
}

}  // namespace

void require_table_spacing(const LosReport& report) {
  if (report.profile.has_length() && report.table_spacing_m != 0) spacing_of(report);
}

std::vector<Table> path_tables(const LosReport& report) {
  std::vector<Table> tables;
  const std::vector<ThemeLength> cover = path_cover(report.profile);
  if (cover.size() > 1 || (!cover.empty() && cover.front().theme != 0) || !report.profile.gaps.empty())
    tables.push_back(cover_table(report, cover));
  if (report.losses && (report.losses->bullington || !report.losses->deygout.empty()))
    tables.push_back(edges_table(*report.losses, unit_of(report)));
  if (report.reflection) tables.push_back(reflection_table(report));
  return tables;
}

std::optional<Table> profile_table(const LosReport& report) {
  if (!report.profile.has_length() || report.table_spacing_m == 0) return std::nullopt;
  const double spacing = spacing_of(report);
  const bool in_km = unit_of(report) == DistanceUnit::kKilometres;
  Table table{fmt::format("Profile, every {:g} {}", in_km ? spacing / 1000 : spacing, in_km ? "km" : "m"),
              {fmt::format("distance {}", in_km ? "km" : "m"), "ground m", "top m", "bulge m", "line m"},
              {},
              "Besides, whatever the spacing: the ends, the critical point, the deepest place of each obstruction"};
  if (report.query.radio) {
    table.header.insert(table.header.end(), {"F1 m", "clearance m", "clearance / F1"});
    table.note += ", the least clearance / F1, the edges and the reflection point";
  } else {
    table.header.emplace_back("clearance m");
  }
  table.header.emplace_back("what is there");
  table.note +=
      ". Top: of what stands on the ground. Bulge: of the effective Earth over the chord between the ends. Clearance: "
      "line less top and bulge.";
  for (const NamedPlace& place : places_at(report, spacing)) table.rows.push_back(profile_row(report, place));
  return table;
}

}  // namespace itin::profile
