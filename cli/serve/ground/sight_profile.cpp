#include "serve/ground/sight_profile.hpp"

#include <cmath>
#include <vector>

#include <profile/fresnel.hpp>

namespace itin::cli {

namespace {

/// Places lie no farther apart than this part of the line.
constexpr double kFarthestApart = 1.0 / 200;

double to_millimetres(double metres) {
  return std::round(1000 * metres) / 1000;
}

profile::ProfilePoint between(const profile::ProfilePoint& a, const profile::ProfilePoint& b, double t) {
  profile::ProfilePoint p = a;
  p.distance_m += t * (b.distance_m - a.distance_m);
  p.x += t * (b.x - a.x), p.y += t * (b.y - a.y);
  p.ground_m += t * (b.ground_m - a.ground_m);
  return p;
}

std::vector<profile::ProfilePoint> places_along(const profile::Profile& profile) {
  std::vector<profile::ProfilePoint> places;
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const profile::ProfilePoint& a = profile.points[i];
    places.push_back(a);
    if (i + 1 == profile.points.size() || !profile.joined(i)) continue;
    const profile::ProfilePoint& b = profile.points[i + 1];
    const double parts = std::ceil((b.distance_m - a.distance_m) / (kFarthestApart * profile.length_m));
    for (double part = 1; part < parts; ++part) places.push_back(between(a, b, part / parts));
  }
  return places;
}

/// The elevation of the ground under a place, without raised features.
Document ground_under(const profile::LosReport& report, const profile::ProfilePoint& place) {
  if (report.ground.points.empty()) return to_millimetres(place.ground_m);
  const auto ground = height_at(report.ground, place.distance_m);
  return ground ? Document(to_millimetres(*ground)) : Document(nullptr);
}

}  // namespace

Document sight_profile(const profile::LosReport& report) {
  const double length = report.profile.length_m, drop = report.query.earth.drop_coefficient();
  Document lists;
  const auto add = [&](const char* list, Document value) { lists[list].push_back(std::move(value)); };
  for (const profile::ProfilePoint& p : places_along(report.profile)) {
    const double d = p.distance_m, rest = length - d, bulge = drop * d * rest;
    add("distance_m", to_millimetres(d));
    add("x", to_millimetres(p.x));
    add("y", to_millimetres(p.y));
    add("surface_m", to_millimetres(p.ground_m));
    add("ground_m", ground_under(report, p));
    add("theme", p.theme);
    add("ray_m", to_millimetres(ray_elevation_m(report, d) - bulge));
    add("curvature_m", to_millimetres(bulge));
    if (report.query.radio && length > 0)
      add("fresnel_m",
          to_millimetres(profile::fresnel_radius_m(d, rest, wavelength_m(report.query.radio->frequency_ghz))));
  }
  if (!lists.contains("fresnel_m")) lists["fresnel_m"] = nullptr;
  lists["gaps"] = Document::array();
  for (const auto& [from, to] : report.profile.gaps) lists["gaps"].push_back({from, to});
  return lists;
}

}  // namespace itin::cli
