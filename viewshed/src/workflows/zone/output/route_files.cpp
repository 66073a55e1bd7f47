#include "workflows/zone/output/route_files.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/counted.hpp>
#include <itin/file_name.hpp>
#include <itin/grid_reference.hpp>
#include <itin/output_file.hpp>
#include <itin/table_columns.hpp>
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

/// Returns a cell of what is seen from a place; empty where there is no ground.
template <class Of>
auto of_found(Found found, Of of) {
  return [found, of](const RoutePlace& place) { return if_any(place.*found, of); };
}

std::vector<TableColumn<RoutePlace>> place_columns(const Zone& zone, bool national) {
  std::vector<TableColumn<RoutePlace>> columns;
  const auto add = [&](const char* name, auto of, const char* number = "{}") {
    columns.emplace_back(name, of, kInCsv, number);
  };
  add("distance_m", &RoutePlace::distance, "{:.0f}");
  add(
      "x", [](const RoutePlace& p) { return p.position.x; }, "{:.1f}");
  add(
      "y", [](const RoutePlace& p) { return p.position.y; }, "{:.1f}");
  add("grid_reference",
      [national](const RoutePlace& p) { return national ? national_grid_reference(p.position) : std::nullopt; });
  add(
      "ground_m", [](const RoutePlace& p) { return if_any(p.bare, [&](const SightSummary&) { return p.ground; }); },
      "{:.1f}");
  add("hubs_visible", of_found(&RoutePlace::bare, &SightSummary::hubs));
  add("tips_visible", of_found(&RoutePlace::bare, &SightSummary::tips));
  add("nearest_turbine", of_found(&RoutePlace::bare, [&zone](const SightSummary& seen) {
        return zone.request.turbines[seen.nearest].number;
      }));
  add("nearest_m", of_found(&RoutePlace::bare, &SightSummary::nearest_m), "{:.0f}");
  if (zone.screened) {
    add("hubs_visible_screened", of_found(&RoutePlace::screened, &SightSummary::hubs));
    add("tips_visible_screened", of_found(&RoutePlace::screened, &SightSummary::tips));
  }
  add("tips_undecided", of_found(&RoutePlace::bare, &SightSummary::tips_undecided));
  if (zone.screened) add("tips_undecided_screened", of_found(&RoutePlace::screened, &SightSummary::tips_undecided));
  return columns;
}

/// A route over one surface.
struct RouteRow {
  std::size_t number;
  std::string title;
  const char* surface;
  double length;
  RouteTotals totals;
  bool hubs;  ///< whether hubs are known
};

std::vector<TableColumn<RouteRow>> route_columns() {
  std::vector<TableColumn<RouteRow>> columns;
  const auto add = [&](const char* name, auto of, const char* number = "{}") {
    columns.emplace_back(name, of, kInCsv, number);
  };
  const auto percent = [](const RouteRow& r, double metres) { return 100 * metres / std::max(1e-9, r.length); };
  const auto of_hubs = [](auto of) {
    return [of](const RouteRow& r) { return r.hubs ? std::optional(of(r)) : std::nullopt; };
  };
  add("route", [](const RouteRow& r) { return r.number; });
  add("name", [](const RouteRow& r) { return r.title; });
  add("surface", [](const RouteRow& r) { return r.surface; });
  add(
      "length_km", [](const RouteRow& r) { return r.length / 1000; }, "{:.2f}");
  add(
      "tips_visible_km", [](const RouteRow& r) { return r.totals.tips_m / 1000; }, "{:.2f}");
  add(
      "tips_visible_percent", [percent](const RouteRow& r) { return percent(r, r.totals.tips_m); }, "{:.1f}");
  add("hubs_visible_km", of_hubs([](const RouteRow& r) { return r.totals.hubs_m / 1000; }), "{:.2f}");
  add("hubs_visible_percent", of_hubs([percent](const RouteRow& r) { return percent(r, r.totals.hubs_m); }), "{:.1f}");
  add("most_tips_visible", [](const RouteRow& r) { return r.totals.most_tips; });
  add("stretches_with_tips", [](const RouteRow& r) { return r.totals.stretches; });
  add(
      "no_data_km", [](const RouteRow& r) { return r.totals.unknown_m / 1000; }, "{:.2f}");
  add(
      "tips_undecided_km", [](const RouteRow& r) { return r.totals.undecided_m / 1000; }, "{:.2f}");
  return columns;
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
        csv_of(place_columns(study_.zone, is_national_grid(study_.metadata.crs_wkt)), route.places));
    add_surface(route, &RoutePlace::bare, "", "Bare ground");
    if (study_.zone.screened)
      add_surface(
          route, &RoutePlace::screened, "-screened",
          fmt::format("Ground with {}", fmt::join(study_.zone.request.themes->names(study_.metadata.themes), ", ")));
  }

  std::vector<ZoneFile> finish() && {
    add("routes.csv", "a row for each route: kilometres from where tips and hubs are visible",
        csv_of(route_columns(), rows_));
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
    rows_.push_back({route.number, route.title(), suffix.empty() ? "bare" : "screened", route.length,
                     totals_of(route, found), hubs});
  }

  std::string folder_, stem_, what_;
  const ZoneStudy& study_;
  std::vector<RouteRow> rows_;
  std::vector<ZoneFile> files_;
};

}  // namespace

std::vector<ZoneFile> write_routes(const std::string& folder, const ZoneStudy& study) {
  RouteWriter writer(folder, study);
  for (const StudiedRoute& route : study.routes) writer.write(route);
  return std::move(writer).finish();
}

}  // namespace itin::viewshed
