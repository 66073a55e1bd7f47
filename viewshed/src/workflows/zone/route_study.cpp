#include "workflows/zone/route_study.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/paths.hpp>
#include <viewshed/turbine_sights.hpp>

#include "workflows/zone/sight_summary.hpp"

namespace itin::viewshed {

namespace {

constexpr double kMostRoutePlaces = 100000;

/// Divides the route into as few equally long stretches of at most `every` metres as possible, and returns the place in
/// the middle of each. `at` are the corners' distances along the route.
std::vector<RoutePlace> places_along(const std::vector<Point2>& corners, const std::vector<double>& at, double every) {
  if (at.back() / every > kMostRoutePlaces)
    throw InputError(
        fmt::format("`route_step` {:g}: a route of {:.0f} m would have more than {:g} places; give a greater distance",
                    every, at.back(), kMostRoutePlaces),
        "route_step");
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(at.back() / every - 1e-9)));
  std::vector<RoutePlace> places;
  std::size_t side = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double d = at.back() * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    while (side + 2 < corners.size() && at[side + 1] < d) ++side;
    const double length = at[side + 1] - at[side], share = length > 0 ? (d - at[side]) / length : 0;
    const Point2 &a = corners[side], &b = corners[side + 1];
    places.push_back({d, {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}, std::nan(""), {}, {}});
  }
  return places;
}

/// Looks from a place, where it is on the ground.
void look_from_place(RoutePlace& place, const StudySurfaces& surfaces, const Zone& zone) {
  const CrossSection here = surfaces.ground.between(place.position, place.position);
  if (here.breakpoints.empty()) return;
  place.ground = here.breakpoints.front().position.z;
  Viewpoint v;
  v.position = place.position, v.ground = place.ground, v.height = zone.request.observer_height;
  const std::vector<std::size_t> all = all_turbines(zone);
  place.bare = seen_of(zone, sights_to_all(surfaces.ground, v, zone), all);
  if (surfaces.features) place.screened = seen_of(zone, sights_to_all(*surfaces.features, v, zone), all);
}

StudiedRoute look_along(const ZoneRoute& route, std::size_t number, double step, const StudySurfaces& surfaces,
                        const Zone& zone, Progress& progress) {
  const std::vector<double> at = distances_along(route.corners);
  StudiedRoute studied{number, route, at.back(), places_along(route.corners, at, step)};
  std::size_t done = 0;
  for (RoutePlace& place : studied.places) {
    progress.throw_if_cancelled();
    progress.report(fmt::format("route {}", number),
                    static_cast<double>(done++) / static_cast<double>(studied.places.size()));
    look_from_place(place, surfaces, zone);
  }
  return studied;
}

}  // namespace

std::string StudiedRoute::title() const {
  return route.name.empty() ? fmt::format("route {}", number) : route.name;
}

RouteTable read_routes(const std::string& path, const std::string& to_crs) {
  RouteTable table;
  table.path = path;
  for (Path& line : read_paths(path, to_crs, table.warnings))
    table.routes.push_back({std::move(line.name), std::move(line.corners)});
  return table;
}

std::vector<StudiedRoute> study_routes(const StudySurfaces& surfaces, const ZoneStudyRequest& request, const Zone& zone,
                                       Progress& progress) {
  std::vector<StudiedRoute> routes;
  for (const ZoneRoute& route : request.routes.routes) {
    routes.push_back(look_along(route, routes.size() + 1, request.route_step, surfaces, zone, progress));
    const StudiedRoute& last = routes.back();
    if (std::none_of(last.places.begin(), last.places.end(), [](const RoutePlace& p) { return p.bare.has_value(); }))
      throw InputError(fmt::format("{}: {} lies off the data", request.routes.path, last.title()), "routes");
  }
  return routes;
}

}  // namespace itin::viewshed
