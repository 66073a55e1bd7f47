#include "report/tables.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <itin/grazing.hpp>

namespace itin::profile {

namespace {

constexpr std::size_t kMostObstructions = 12;

std::string metres(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? fmt::format("{:.2f} m", *value) : "none is enough";
}

std::string capitalised(std::string text) {
  text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

/// The theme of the feature at a distance; 0: none.
std::uint16_t theme_at(const Profile& profile, double distance_m) {
  for (std::size_t i = 0; i + 1 < profile.points.size(); ++i) {
    const bool holds = profile.points[i].distance_m <= distance_m && distance_m <= profile.points[i + 1].distance_m;
    if (holds && profile.theme_between(i) != 0) return profile.theme_between(i);
  }
  return 0;
}

Table criteria_table(const LosReport& report) {
  Table table{"Verdicts", {"K", "wanted", "least clearance", "least of F1", "verdict"}, {}, ""};
  table.rows.push_back(
      {"as above", "line of sight", report.clearance_m ? fmt::format("{:.2f} m", *report.clearance_m) : "",
       report.fresnel ? fmt::format("{:.3f} F1", report.fresnel->fraction) : "", name_of(report.verdict)});
  for (const CriterionResult& c : report.criteria) {
    table.rows.push_back({fmt::format("{:.4g}", c.criterion.k), fmt::format("{:g} F1", c.criterion.fraction),
                          c.clearance_m ? fmt::format("{:.2f} m", *c.clearance_m) : "",
                          c.clearance_f1 ? fmt::format("{:.3f} F1", *c.clearance_f1) : "", name_of(c.verdict)});
  }
  if (report.query.clearance_error_m > 0) {
    table.note = fmt::format("Undecided: the surface's certified error of {:.2f} m leaves it open.",
                             report.query.clearance_error_m);
  }
  return table;
}

Table obstructions_table(const LosReport& report) {
  Table table{"Obstructions", {"from", "to", "deepest at", "elevation", "depth", "cause"}, {}, ""};
  std::vector<const Obstruction*> list;
  for (const Obstruction& o : report.obstructions) list.push_back(&o);
  if (list.size() > kMostObstructions) {
    std::stable_sort(list.begin(), list.end(), [](const auto* a, const auto* b) { return a->depth_m > b->depth_m; });
    list.resize(kMostObstructions);
    std::sort(list.begin(), list.end(), [](const auto* a, const auto* b) { return a->from_m < b->from_m; });
    table.note = fmt::format("The {} deepest of {}; the JSON document has them all.", kMostObstructions,
                             report.obstructions.size());
  }
  for (const Obstruction* o : list) {
    table.rows.push_back({fmt::format("{:.1f} m", o->from_m), fmt::format("{:.1f} m", o->to_m),
                          fmt::format("{:.1f} m", o->peak_at_m), fmt::format("{:.2f} m", o->peak_m),
                          fmt::format("{:.2f} m", o->depth_m), cause_of(report, o->theme, o->feature)});
  }
  return table;
}

Table heights_table(const LosReport& report) {
  const LosQuery& query = report.query;
  std::string above = base_name(query.from_on_surface);
  if (query.from_on_surface != query.to_on_surface)
    above += fmt::format(" (A) and {} (B)", base_name(query.to_on_surface));
  Table table{"Required heights above " + above, {"for", "first end alone", "second end alone", "both equal"}, {}, ""};
  for (const NamedHeights& named : report.required) {
    table.rows.push_back({named.name, metres(named.heights.from_alone_m), metres(named.heights.to_alone_m),
                          metres(named.heights.both_equal_m)});
  }
  table.note = "Alone: the other end stays at its planned height. Where criteria differ the greatest height rules.";
  return table;
}

Table losses_table(const LosReport& report) {
  const PathLosses& l = *report.losses;
  const auto db = [](double value) { return fmt::format("{:.2f} dB", value); };
  Table table{"Losses", {}, {}, ""};
  table.rows = {{"Free space (P.525), slant path", db(l.free_space_db)},
                {"Single knife edge J(v) (P.526 4.1)", db(l.knife_edge_db)},
                {"Bullington over the terrain, Lba (P.452 4.2.1)", db(l.lba_db)},
                {"Bullington over the smooth surface, Lbs", db(l.lbs_db)},
                {"Spherical Earth, Ldsph (P.452 4.2.2)", db(l.ldsph_db)},
                {"Delta-Bullington, Ld (P.452 4.2.3)", db(l.ld_db)},
                {"For comparison: Deygout, three edges (P.526-12 4.4.2)", db(l.deygout_db)},
                {"Free space + delta-Bullington", db(l.free_space_db + l.ld_db)}};
  return table;
}

Table geometry_table(const LosReport& report) {
  const PathLosses& l = *report.losses;
  const auto km = [](const std::optional<double>& v) { return v ? fmt::format("{:.3f} km", *v) : std::string("none"); };
  Table table{"Path", {}, {}, ""};
  table.rows = {
      {"Path (P.452)", l.horizons.trans_horizon ? "trans-horizon" : "line-of-sight"},
      {"Least clearance / F1",
       report.fresnel ? fmt::format("{:.3f} at {}", report.fresnel->fraction, distance_text(report.fresnel->distance_m))
                      : "none"},
      {"Horizon angles", fmt::format("{:.3f} and {:.3f} mrad", l.horizons.theta_t_mrad, l.horizons.theta_r_mrad)},
      {"Horizon distances", km(l.horizons.dlt_km) + " and " + km(l.horizons.dlr_km)},
      {"Smooth surface at the ends", fmt::format("{:.2f} and {:.2f} m", l.smooth.hstd_m, l.smooth.hsrd_m)},
      {"Largest v", l.largest_v ? fmt::format("{:.3f}", *l.largest_v) : "none"}};
  return table;
}

Table object_table(const LosReport& report) {
  const VisibleHeight& seen = *report.visible;
  const TallObject& object = *report.query.object;
  return {"Seen of the object at the second end",
          {},
          {{"Hidden below", fmt::format("{:.2f} m above its {}", seen.from_m, base_name(report.query.to_on_surface))},
           {fmt::format("Up to the hub, {:g} m", object.hub_m),
            fmt::format("{:.2f} m, {:.0f} %", seen.hub_visible_m, 100 * seen.hub_fraction)},
           {fmt::format("Up to the tip, {:g} m", object.tip_m),
            fmt::format("{:.2f} m, {:.0f} %", seen.tip_visible_m, 100 * seen.tip_fraction)}},
          ""};
}

/// The tightest place of a free path. Where no frequency is given, and the least clearance is that of an end over its
/// own foot, any wavelength finds the same place.
std::optional<FresnelClearance> tightest_zone(const LosReport& report) {
  if (*report.clearance_m < -kGrazing) return std::nullopt;
  if (report.fresnel) return report.fresnel;
  const double d = report.critical->distance_m;
  if (d > 0 && d < report.profile.length_m) return std::nullopt;
  return fresnel_clearance(report.profile, report.antennas, report.query.earth, 1);
}

}  // namespace

const char* base_name(bool on_surface) {
  return on_surface ? "surface" : "ground";
}

std::string distance_text(double metres) {
  return metres < 2000 ? fmt::format("{:.1f} m", metres) : fmt::format("{:.3f} km", metres / 1000);
}

std::optional<TightestPoint> tightest_point(const LosReport& report) {
  if (!report.critical || !report.clearance_m) return std::nullopt;
  if (const auto zone = tightest_zone(report)) {
    const double d = zone->distance_m,
                 bulge = report.query.earth.drop_coefficient() * d * (report.profile.length_m - d);
    const std::optional<double> fraction = report.fresnel ? std::optional(zone->fraction) : std::nullopt;
    return TightestPoint{d,
                         ray_elevation_m(report, d) - bulge - zone->clearance_m,
                         zone->clearance_m,
                         fraction,
                         theme_at(report.profile, d),
                         -1};
  }
  const ProfilePoint& p = *report.critical;
  TightestPoint point{p.distance_m, p.ground_m, *report.clearance_m, {}, p.theme, p.feature};
  if (report.query.radio) {
    const double radius = fresnel_radius_m(p.distance_m, report.profile.length_m - p.distance_m,
                                           wavelength_m(report.query.radio->frequency_ghz));
    if (radius > 0) point.fraction = point.clearance_m / radius;
  }
  return point;
}

std::string critical_line(const LosReport& report) {
  const auto point = tightest_point(report);
  if (!point) return "no ground between the ends";
  return fmt::format("{}: clearance {:.2f} m{}; {}", distance_text(point->distance_m), point->clearance_m,
                     point->fraction ? fmt::format(", {:.2f} F1", *point->fraction) : "",
                     cause_of(report, point->theme, point->feature));
}

std::string verdict_line(const LosReport& report) {
  std::string distance = distance_text(report.profile.length_m);
  if (report.geodesic_m) distance += fmt::format(" on the grid, {} geodesic", distance_text(*report.geodesic_m));
  return fmt::format("{}. Distance {}; critical point at {}.", capitalised(name_of(report.verdict)), distance,
                     critical_line(report));
}

Table facts_table(const LosReport& report) {
  Table table{"Inputs", {}, {}, ""};
  for (const auto& [name, value] : report.facts) table.rows.push_back({name, value});
  return table;
}

Table ends_table(const LosReport& report) {
  Table table{"Ends", {"First end (A)", "Second end (B)"}, {}, ""};
  for (std::size_t i = 0; i < std::max(report.from_lines.size(), report.to_lines.size()); ++i) {
    const auto line = [i](const std::vector<std::string>& lines) {
      return i < lines.size() ? lines[i] : std::string();
    };
    table.rows.push_back({line(report.from_lines), line(report.to_lines)});
  }
  return table;
}

std::vector<Table> result_tables(const LosReport& report) {
  std::vector<Table> tables = {criteria_table(report)};
  if (!report.obstructions.empty()) tables.push_back(obstructions_table(report));
  if (!report.required.empty()) tables.push_back(heights_table(report));
  if (report.losses) tables.push_back(geometry_table(report)), tables.push_back(losses_table(report));
  if (report.visible) tables.push_back(object_table(report));
  return tables;
}

}  // namespace itin::profile
