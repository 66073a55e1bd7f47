#include "ztv/ztv_route.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/cross_section.hpp>
#include <itin/csv_cell.hpp>
#include <itin/error.hpp>
#include <itin/file_name.hpp>
#include <itin/grid_reference.hpp>
#include <itin/output_file.hpp>
#include <itin/paths.hpp>
#include <profile/route_chart.hpp>

#include "options/memory_option.hpp"
#include "output/output_path.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"
#include "ztv/ztv_sights.hpp"

namespace itin::cli {

namespace {

using viewshed::Zone;

constexpr double kMostPlaces = 100000;

struct RoutePlace {
  double distance = 0;
  Point2 position;
};

/// Divides the route into as few equally long stretches of at most `every` metres as possible, and returns the place in
/// the middle of each. `at` are the corners' distances along the route.
std::vector<RoutePlace> places_along(const std::vector<Point2>& corners, const std::vector<double>& at, double every) {
  if (at.back() / every > kMostPlaces)
    throw InputError(
        fmt::format("--every {:g}: a route of {:.0f} m would have more than {:g} places; give a greater distance",
                    every, at.back(), kMostPlaces));
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(at.back() / every - 1e-9)));
  std::vector<RoutePlace> places;
  std::size_t side = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double d = at.back() * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    while (side + 2 < corners.size() && at[side + 1] < d) ++side;
    const double length = at[side + 1] - at[side], share = length > 0 ? (d - at[side]) / length : 0;
    const Point2 &a = corners[side], &b = corners[side + 1];
    places.push_back({d, {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}});
  }
  return places;
}

/// The sights from one place, summed up; nothing where there is no ground.
using Found = std::optional<Seen>;

struct Route {
  std::string name;
  std::size_t number = 1;
  double length = 0;
  std::vector<RoutePlace> places;
  std::vector<double> ground;              ///< NaN: none
  std::vector<Found> bare, screened;       ///< one per place; the second empty without features
  std::vector<std::vector<Sight>> sights;  ///< over bare ground
};

std::vector<profile::RouteStep> steps_of(const Route& route, const std::vector<Found>& found) {
  std::vector<profile::RouteStep> steps;
  const double step = route.length / static_cast<double>(found.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    profile::RouteStep& s = steps.emplace_back();
    s.from_m = step * static_cast<double>(k), s.to_m = s.from_m + step, s.known = found[k].has_value();
    if (found[k]) s.tips = found[k]->tips, s.hubs = found[k]->hubs, s.tips_undecided = found[k]->tips_undecided;
  }
  return steps;
}

struct Totals {
  double tips_m = 0, hubs_m = 0, unknown_m = 0;
  double undecided_m = 0;  ///< the length from where no tip is certainly seen, but one may be
  std::size_t most_tips = 0, stretches = 0;
};

Totals totals_of(const Route& route, const std::vector<Found>& found) {
  Totals totals;
  bool before = false;
  for (const profile::RouteStep& s : steps_of(route, found)) {
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

std::string count(const Found& found, bool hubs) {
  if (!found) return "";
  return hubs ? (found->hubs ? fmt::format("{}", *found->hubs) : "") : fmt::format("{}", found->tips);
}

std::string table_of(const Route& route, const Zone& zone, bool national) {
  const bool screened = !route.screened.empty();
  std::string table =
      fmt::format("distance_m,x,y,grid_reference,ground_m,hubs_visible,tips_visible,nearest_turbine,nearest_m{}\n",
                  screened ? ",hubs_visible_screened,tips_visible_screened,tips_undecided,tips_undecided_screened"
                           : ",tips_undecided");
  for (std::size_t k = 0; k < route.places.size(); ++k) {
    const RoutePlace& p = route.places[k];
    const auto reference = national ? national_grid_reference(p.position) : std::nullopt;
    table += fmt::format("{:.0f},{:.1f},{:.1f},{},", p.distance, p.position.x, p.position.y, reference.value_or(""));
    if (!route.bare[k]) {
      table += screened ? ",,,,,,,,\n" : ",,,,,\n";
      continue;
    }
    const std::size_t nearest = route.bare[k]->nearest;
    table +=
        fmt::format("{:.1f},{},{},{},{:.0f}", route.ground[k], count(route.bare[k], true), count(route.bare[k], false),
                    zone.request.turbines[nearest].number, route.sights[k][nearest].distance);
    if (screened) table += fmt::format(",{},{}", count(route.screened[k], true), count(route.screened[k], false));
    table += fmt::format(",{}", route.bare[k]->tips_undecided);
    table += screened ? fmt::format(",{}\n", route.screened[k]->tips_undecided) : "\n";
  }
  return table;
}

std::string route_row(const Route& route, const char* surface, const std::vector<Found>& found, bool hubs) {
  const Totals t = totals_of(route, found);
  const auto percent = [&](double metres) {
    return fmt::format("{:.1f}", 100 * metres / std::max(1e-9, route.length));
  };
  return fmt::format("{},{},{},{:.2f},{:.2f},{},{},{},{},{},{:.2f},{:.2f}\n", route.number, csv_cell(route.name),
                     surface, route.length / 1000, t.tips_m / 1000, percent(t.tips_m),
                     hubs ? fmt::format("{:.2f}", t.hubs_m / 1000) : "", hubs ? percent(t.hubs_m) : "", t.most_tips,
                     t.stretches, t.unknown_m / 1000, t.undecided_m / 1000);
}

void survey(Route& route, const SectionSurface& ground, const SectionSurface* features, const Zone& zone,
            Progress& progress) {
  const std::vector<std::size_t> all = all_turbines(zone);
  for (const RoutePlace& p : route.places) {
    progress.throw_if_cancelled();
    progress.report(fmt::format("route {}", route.number),
                    static_cast<double>(route.bare.size()) / static_cast<double>(route.places.size()));
    const CrossSection here = ground.between(p.position, p.position);
    const bool known = !here.breakpoints.empty();
    route.ground.push_back(known ? here.breakpoints.front().position.z : std::nan(""));
    route.sights.emplace_back();
    if (!known) {
      route.bare.emplace_back();
      if (features != nullptr) route.screened.emplace_back();
      continue;
    }
    Viewpoint v;
    v.position = p.position, v.ground = route.ground.back(), v.height = zone.request.observer_height;
    route.sights.back() = sights_to_all(ground, v, zone);
    route.bare.emplace_back(seen_of(zone, route.sights.back(), all));
    if (features != nullptr) route.screened.emplace_back(seen_of(zone, sights_to_all(*features, v, zone), all));
  }
}

}  // namespace

std::string route_name(const Path& route, std::size_t number) {
  return route.name.empty() ? fmt::format("route {}", number) : route.name;
}

void RouteOptions::declare(CLI::App& app) {
  begin_group(app, "Routes");
  reads(app.add_option("--route", path_,
                       "Roads or paths from a vector file of lines: tables and charts of the hubs and tips visible "
                       "along each")
            ->type_name("FILE"));
  app.add_option("--every", every_text_,
                 "Distance between the places along a route from which turbines are looked for (default: 100)")
      ->type_name("METRES");
}

void RouteOptions::validate() {
  if (every_text_.empty()) return;
  if (!given()) throw InputError("--every works only with --route");
  every_ = parse_radius("--every", every_text_);
}

Document RouteOptions::parameters() const {
  if (!given()) return Document::object();
  return {{"route", path_}, {"every_m", every_}};
}

RouteOptions::Written RouteOptions::write(const std::string& folder, const Store& store, const Zone& zone,
                                          Progress& progress) const {
  const StoreMetadata& metadata = store.metadata();
  const SectionSurface::Options cache = section_cache_within(zone.request.memory_bytes);
  const SectionSurface ground(store, zone.request.detail, ThemeChoice::none(), cache);
  std::optional<SectionSurface> features;
  if (zone.request.themes) features.emplace(store, zone.request.detail, *zone.request.themes, cache);
  const bool national = is_national_grid(metadata.crs_wkt);
  Written written;
  const auto add = [&](const std::string& name, const std::string& what, const std::string& bytes) {
    write_file(folder + "/" + name, bytes, true);
    written.files.push_back({name, what});
  };
  std::string summary =
      "route,name,surface,length_km,tips_visible_km,tips_visible_percent,hubs_visible_km,hubs_visible_percent,"
      "most_tips_visible,stretches_with_tips,no_data_km,tips_undecided_km\n";
  std::size_t number = 0;
  written.routes = read_paths(path_, metadata.crs_wkt, written.warnings);
  for (const Path& path : written.routes) {
    Route route;
    route.number = ++number;
    route.name = route_name(path, route.number);
    const std::vector<double> at = distances_along(path.corners);
    route.length = at.back();
    route.places = places_along(path.corners, at, every_);
    survey(route, ground, features ? &*features : nullptr, zone, progress);
    if (std::none_of(route.bare.begin(), route.bare.end(), [](const Found& f) { return f.has_value(); }))
      throw InputError(fmt::format("{}: {} lies off the data", path_, route.name));
    const std::string stem = file_name(path.name.empty() ? fmt::format("route-{}", route.number)
                                                         : fmt::format("route-{}-{}", route.number, path.name));
    const std::string what = path.name.empty() ? route.name : fmt::format("route {}, {}", route.number, path.name);
    add(stem + ".csv", what + ": hubs and tips visible place by place", table_of(route, zone, national));
    const auto draw = [&](const std::vector<Found>& found, const std::string& suffix, const std::string& surface) {
      profile::RouteChart chart;
      chart.title = fmt::format("Turbines visible along {}", route.name);
      chart.note =
          fmt::format("{}; eyes {:g} m above the ground, every {:g} m; {}; {}", surface, zone.request.observer_height,
                      every_, counted(zone.request.turbines.size(), "turbine"), zone.request.earth.convention());
      chart.steps = steps_of(route, found), chart.turbines = zone.request.turbines.size();
      for (const char* ending : {".pdf", ".svg"})
        add(stem + suffix + ending, what + ": chart of hubs and tips visible",
            profile::draw_route_chart(chart, stem + suffix + ending));
      const bool hubs = std::any_of(found.begin(), found.end(), [](const Found& f) { return f && f->hubs; });
      summary += route_row(route, suffix.empty() ? "bare" : "screened", found, hubs);
    };
    draw(route.bare, "", "Bare ground");
    if (features)
      draw(route.screened, "-screened",
           fmt::format("Ground with {}", fmt::join(zone.request.themes->names(metadata.themes), ", ")));
  }
  add("routes.csv", "a row for each route: kilometres from where tips and hubs are visible", summary);
  return written;
}

}  // namespace itin::cli
