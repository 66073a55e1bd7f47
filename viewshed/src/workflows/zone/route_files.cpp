#include "workflows/zone/route_files.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/counted.hpp>
#include <itin/csv_cell.hpp>
#include <itin/file_name.hpp>
#include <itin/grid_reference.hpp>
#include <itin/output_file.hpp>
#include <profile/route_chart.hpp>

namespace itin::viewshed {

namespace {

/// What is seen from a place: over bare ground or over what screens.
using Found = std::optional<SightSummary> RoutePlace::*;

std::vector<profile::RouteStep> steps_along(const StudiedRoute& route, Found found) {
  std::vector<profile::RouteStep> steps;
  const double step = route.length / static_cast<double>(route.places.size());
  for (std::size_t k = 0; k < route.places.size(); ++k) {
    profile::RouteStep& s = steps.emplace_back();
    const std::optional<SightSummary>& seen = route.places[k].*found;
    s.from_m = step * static_cast<double>(k), s.to_m = s.from_m + step, s.known = seen.has_value();
    if (seen) s.tips = seen->tips, s.hubs = seen->hubs, s.tips_undecided = seen->tips_undecided;
  }
  return steps;
}

struct RouteTotals {
  double tips_m = 0, hubs_m = 0, unknown_m = 0;
  double undecided_m = 0;  ///< the length from where no tip is certainly seen, but one may be
  std::size_t most_tips = 0, stretches = 0;
};

RouteTotals totals_of(const StudiedRoute& route, Found found) {
  RouteTotals totals;
  bool before = false;
  for (const profile::RouteStep& s : steps_along(route, found)) {
    const double length = s.to_m - s.from_m;
    if (s.tips > 0) totals.tips_m += length;
    if (s.hubs.value_or(0) > 0) totals.hubs_m += length;
    if (!s.known) totals.unknown_m += length;
    if (s.tips == 0 && s.tips_undecided > 0) totals.undecided_m += length;
    totals.most_tips = std::max(totals.most_tips, s.tips);
    if (s.tips > 0 && !before) ++totals.stretches;
    before = s.tips > 0;
  }
  return totals;
}

std::string count_cell(const std::optional<SightSummary>& found, bool hubs) {
  if (!found) return "";
  return hubs ? (found->hubs ? fmt::format("{}", *found->hubs) : "") : fmt::format("{}", found->tips);
}

std::string place_row(const RoutePlace& p, const Zone& zone, bool national) {
  const bool screened = zone.screened.has_value();
  const auto reference = national ? national_grid_reference(p.position) : std::nullopt;
  std::string row =
      fmt::format("{:.0f},{:.1f},{:.1f},{},", p.distance, p.position.x, p.position.y, reference.value_or(""));
  if (!p.bare) return row + (screened ? ",,,,,,,,\n" : ",,,,,\n");
  row += fmt::format("{:.1f},{},{},{},{:.0f}", p.ground, count_cell(p.bare, true), count_cell(p.bare, false),
                     zone.request.turbines[p.bare->nearest].number, p.bare->nearest_m);
  if (screened) row += fmt::format(",{},{}", count_cell(p.screened, true), count_cell(p.screened, false));
  row += fmt::format(",{}", p.bare->tips_undecided);
  return row + (screened ? fmt::format(",{}\n", p.screened->tips_undecided) : "\n");
}

std::string route_table(const StudiedRoute& route, const Zone& zone, bool national) {
  std::string table =
      fmt::format("distance_m,x,y,grid_reference,ground_m,hubs_visible,tips_visible,nearest_turbine,nearest_m{}\n",
                  zone.screened ? ",hubs_visible_screened,tips_visible_screened,tips_undecided,tips_undecided_screened"
                                : ",tips_undecided");
  for (const RoutePlace& place : route.places) table += place_row(place, zone, national);
  return table;
}

std::string route_row(const StudiedRoute& route, const char* surface, Found found, bool hubs) {
  const RouteTotals t = totals_of(route, found);
  const auto percent = [&](double metres) {
    return fmt::format("{:.1f}", 100 * metres / std::max(1e-9, route.length));
  };
  return fmt::format("{},{},{},{:.2f},{:.2f},{},{},{},{},{},{:.2f},{:.2f}\n", route.number, csv_cell(route.title()),
                     surface, route.length / 1000, t.tips_m / 1000, percent(t.tips_m),
                     hubs ? fmt::format("{:.2f}", t.hubs_m / 1000) : "", hubs ? percent(t.hubs_m) : "", t.most_tips,
                     t.stretches, t.unknown_m / 1000, t.undecided_m / 1000);
}

/// Writes the files of routes.
class RouteWriter {
 public:
  RouteWriter(std::string folder, const ZoneStudy& study) : folder_(std::move(folder)), study_(study) {}

  void write(const StudiedRoute& route) {
    const std::string& name = route.route.name;
    stem_ = file_name(name.empty() ? fmt::format("route-{}", route.number)
                                   : fmt::format("route-{}-{}", route.number, name));
    what_ = name.empty() ? route.title() : fmt::format("route {}, {}", route.number, name);
    add(stem_ + ".csv", what_ + ": hubs and tips visible place by place",
        route_table(route, study_.zone, is_national_grid(study_.metadata.crs_wkt)));
    add_surface(route, &RoutePlace::bare, "", "Bare ground");
    if (study_.zone.screened)
      add_surface(
          route, &RoutePlace::screened, "-screened",
          fmt::format("Ground with {}", fmt::join(study_.zone.request.themes->names(study_.metadata.themes), ", ")));
  }

  std::vector<ZoneFile> finish() && {
    add("routes.csv", "a row for each route: kilometres from where tips and hubs are visible", summary_);
    return std::move(files_);
  }

 private:
  void add(const std::string& name, const std::string& what, const std::string& bytes) {
    write_file(folder_ + "/" + name, bytes, true);
    files_.push_back({name, what});
  }

  /// Draws what is seen over one surface, and adds it to the summary.
  void add_surface(const StudiedRoute& route, Found found, const std::string& suffix, const std::string& surface) {
    const ZoneRequest& request = study_.zone.request;
    profile::RouteChart chart;
    chart.title = fmt::format("Turbines visible along {}", route.title());
    chart.note =
        fmt::format("{}; eyes {:g} m above the ground, every {:g} m; {}; {}", surface, request.observer_height,
                    study_.request.route_step, counted(request.turbines.size(), "turbine"), request.earth.convention());
    chart.steps = steps_along(route, found), chart.turbines = request.turbines.size();
    for (const char* ending : {".pdf", ".svg"})
      add(stem_ + suffix + ending, what_ + ": chart of hubs and tips visible",
          profile::draw_route_chart(chart, stem_ + suffix + ending));
    const bool hubs = std::any_of(route.places.begin(), route.places.end(),
                                  [&](const RoutePlace& p) { return p.*found && (p.*found)->hubs; });
    summary_ += route_row(route, suffix.empty() ? "bare" : "screened", found, hubs);
  }

  std::string folder_, stem_, what_;
  const ZoneStudy& study_;
  std::string summary_ =
      "route,name,surface,length_km,tips_visible_km,tips_visible_percent,hubs_visible_km,hubs_visible_percent,"
      "most_tips_visible,stretches_with_tips,no_data_km,tips_undecided_km\n";
  std::vector<ZoneFile> files_;
};

}  // namespace

std::vector<ZoneFile> write_routes(const std::string& folder, const ZoneStudy& study) {
  RouteWriter writer(folder, study);
  for (const StudiedRoute& route : study.routes) writer.write(route);
  return std::move(writer).finish();
}

}  // namespace itin::viewshed
