#include "report/tables/tables.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <profile/radio_text.hpp>
#include <profile/report_text.hpp>

#include "report/tables/budget_table.hpp"
#include "report/tables/path_tables.hpp"

namespace itin::profile {

namespace {

constexpr std::size_t kMostObstructions = 12;

std::string clearance_text(const std::optional<double>& clearance_m) {
  return clearance_m ? fmt::format("{:.2f} m", *clearance_m) : "";
}
std::string fraction_text(double fraction) {
  return fmt::format("{:.2f} F1", fraction);
}

/// Ends of titles, where the line is judged with its clutter and without it.
constexpr const char *kWithClutter = ", with clutter", *kBareGround = ", bare ground";

std::vector<std::string> criterion_row(const CriterionResult& c, DistanceUnit unit) {
  const bool open = c.verdict == CriterionVerdict::kUndecided;
  return {factor_text(c.criterion, c.k), fmt::format("{:g} F1", c.criterion.fraction), clearance_text(c.clearance_m),
          c.clearance_f1 ? fraction_text(*c.clearance_f1) : "", open ? name_of(c.verdict) : outcome_text(c, unit)};
}

Table criteria_table(const LosReport& report, const LineFindings& found, const std::string& of) {
  Table table{"Verdicts" + of, {"K", "wanted", "clearance", "in F1", "verdict"}, {}, ""};
  const double drop = report.query.earth.drop_coefficient();
  const std::string k = drop == 0 ? "flat" : fmt::format("{:.4g}", 1 / (2 * drop * report.query.earth.radius));
  table.rows.push_back({k, "line of sight", clearance_text(found.clearance_m),
                        found.fresnel ? fraction_text(found.fresnel->fraction) : "", name_of(found.verdict)});
  for (const CriterionResult& c : found.criteria) table.rows.push_back(criterion_row(c, unit_of(report)));
  table.note = gap_text(report, unit_of(report));
  if (!table.note.empty()) table.note[0] = 'N', table.note += ".";
  if (const std::string note = fade_note(found, report.profile.length_m); !note.empty())
    table.note += (table.note.empty() ? "" : " ") + note;
  if (report.query.clearance_error_m > 0) {
    table.note += fmt::format(
        "{}Where the verdict is undecided, the surface's certified error, {:.2f} m, is greater than the margin.",
        table.note.empty() ? "" : " ", report.query.clearance_error_m);
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
  const DistanceUnit unit = unit_of(report);
  for (const Obstruction* o : list) {
    table.rows.push_back({distance_text(o->from_m, unit), distance_text(o->to_m, unit),
                          distance_text(o->peak_at_m, unit), fmt::format("{:.2f} m", o->peak_m),
                          fmt::format("{:.2f} m", o->depth_m), cause_of(report, o->theme, o->feature)});
  }
  return table;
}

constexpr const char* kKnownGround = " Only known ground is counted; ground without data may ask for more.";

Table heights_table(const LosReport& report, const LineFindings& found, const std::string& of) {
  const LosQuery& query = report.query;
  std::string above = base_name(query.from_on_surface);
  if (query.from_on_surface != query.to_on_surface)
    above += fmt::format(" (A) and {} (B)", base_name(query.to_on_surface));
  Table table{
      "Required heights above " + above + of, {"for", "first end alone", "second end alone", "both equal"}, {}, ""};
  for (const NamedHeights& named : found.required) {
    table.rows.push_back({named.name, required_text(named.heights.from_alone_m),
                          required_text(named.heights.to_alone_m), required_text(named.heights.both_equal_m)});
  }
  table.note =
      "One end alone: the other stays at its planned height. Where criteria differ, the greatest height governs.";
  if (!report.profile.gaps.empty()) table.note += kKnownGround;
  return table;
}

Table losses_table(const LosReport& report) {
  const PathLosses& l = *report.losses;
  const auto db = [](double value) { return fmt::format("{:.2f} dB", value); };
  Table table{"Losses", {}, {}, "", true};
  table.rows = {{"Free space (P.525), slant path", db(l.free_space_db)},
                {"Single knife edge J(v) (P.526 4.1)", db(l.knife_edge_db)},
                {"Bullington over the terrain, Lba (P.452 4.2.1)", db(l.lba_db)},
                {"Bullington over the smooth surface, Lbs", db(l.lbs_db)},
                {"Spherical Earth, Ldsph (P.452 4.2.2)", db(l.ldsph_db)},
                {"Delta-Bullington, Ld (P.452 4.2.3)", db(l.ld_db)},
                {"For comparison: Deygout, three edges (P.526-12 4.4.2)", db(l.deygout_db)},
                {"Free space + delta-Bullington", db(l.free_space_db + l.ld_db)}};
  if (report.bare) table.note = fmt::format("With clutter, except within {:g} m of the ends.", kClutterFreeM);
  if (!report.profile.gaps.empty()) table.note += kKnownGround;
  return table;
}

Table geometry_table(const LosReport& report) {
  const PathLosses& l = *report.losses;
  const DistanceUnit unit = unit_of(report);
  const auto horizon = [&](const std::optional<double>& km) {
    return km ? distance_text(1000 * *km, unit) : std::string("none");
  };
  Table table{"Path", {}, {}, "", true};
  table.rows = {
      {"Path (P.452)", l.horizons.trans_horizon ? "trans-horizon" : "line-of-sight"},
      {"Least clearance / F1", report.fresnel ? fmt::format("{:.2f} at {}", report.fresnel->fraction,
                                                            distance_text(report.fresnel->distance_m, unit))
                                              : "none"},
      {"Horizon angles", fmt::format("{:.3f} and {:.3f} mrad", l.horizons.theta_t_mrad, l.horizons.theta_r_mrad)},
      {"Horizon distances", horizon(l.horizons.dlt_km) + " and " + horizon(l.horizons.dlr_km)},
      {"Smooth surface at the ends", fmt::format("{:.2f} and {:.2f} m", l.smooth.hstd_m, l.smooth.hsrd_m)},
      {"Largest v", l.largest_v ? fmt::format("{:.3f}", *l.largest_v) : "none"}};
  return table;
}

Table object_table(const LosReport& report) {
  const VisibleHeight& seen = *report.visible;
  const TallObject& object = *report.query.object;
  const auto row = [](const char* top, double height_m, const VisiblePart& part) {
    return std::vector<std::string>{fmt::format("Up to the {}, {:g} m", top, height_m),
                                    fmt::format("{:.2f} m, {:.0f} %", part.visible_m, 100 * part.fraction)};
  };
  Table table{
      "What is seen of the object at the second end",
      {},
      {{"Hidden below", fmt::format("{:.2f} m above its {}", seen.from_m, base_name(report.query.to_on_surface))}},
      report.profile.gaps.empty() ? "" : "Only known ground is counted; ground without data may hide more."};
  if (seen.hub) table.rows.push_back(row("hub", *object.hub_m, *seen.hub));
  table.rows.push_back(row("tip", object.tip_m, seen.tip));
  return table;
}

}  // namespace

const char* base_name(bool on_surface) {
  return on_surface ? "surface" : "ground";
}

std::string critical_line(const LosReport& report) {
  if (!report.critical) return "no ground between the ends";
  const ProfilePoint& p = *report.critical;
  const DistanceUnit unit = unit_of(report);
  const std::string place =
      fmt::format("{}: clearance {:.2f} m", distance_text(p.distance_m, unit), *report.clearance_m);
  const std::string cause = cause_of(report, p.theme, p.feature);
  if (!report.fresnel) return place + "; " + cause;
  const std::string fraction = fraction_text(report.fresnel->fraction);
  const std::string at = distance_text(report.fresnel->distance_m, unit);
  if (at == distance_text(p.distance_m, unit)) return fmt::format("{}, {}; {}", place, fraction, cause);
  return fmt::format("{}; {}; least clearance {} at {}", place, cause, fraction, at);
}

std::string verdict_line(const LosReport& report) {
  const DistanceUnit unit = unit_of(report);
  std::string distance = distance_text(report.profile.length_m, unit);
  if (report.geodesic_m) distance += fmt::format(" on the grid, {} geodesic", distance_text(*report.geodesic_m, unit));
  const std::string bare = report.bare ? fmt::format(" Over bare ground {}.", name_of(report.bare->verdict)) : "";
  return fmt::format("{}{}.{} Distance {}; critical point at {}.", verdict_text(report),
                     report.bare ? kWithClutter : "", bare, distance, critical_line(report));
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
  std::vector<Table> tables;
  const char* of = report.bare ? kWithClutter : "";
  tables.push_back(criteria_table(report, report, of));
  if (report.bare) tables.push_back(criteria_table(report, *report.bare, kBareGround));
  if (!report.obstructions.empty()) tables.push_back(obstructions_table(report));
  if (!report.required.empty()) tables.push_back(heights_table(report, report, of));
  if (report.bare && !report.required.empty()) tables.push_back(heights_table(report, *report.bare, kBareGround));
  const std::vector<Table> along = path_tables(report);
  if (report.losses) tables.push_back(geometry_table(report)), tables.push_back(losses_table(report));
  if (report.budget) tables.push_back(budget_table(report));
  tables.insert(tables.end(), along.begin(), along.end());
  if (report.visible) tables.push_back(object_table(report));
  return tables;
}

}  // namespace itin::profile
