#include "serve/live/live_probe.hpp"

#include <algorithm>
#include <optional>

#include <itin/azimuth.hpp>
#include <itin/feature_at.hpp>
#include <itin/geodesic.hpp>
#include <profile/clearance_error.hpp>
#include <profile/los.hpp>

#include "serve/live/live_view.hpp"

namespace itin::cli {

namespace {

double target_height(const viewshed::Request& request) {
  return request.observers.front().target_height.value_or(request.target_height);
}

/// The line from the first observer to a target at the position, judged as the view judges it.
profile::LosReport line_to(const Store& store, const ServedSurface& surface, const viewshed::Request& request,
                           Point2 position) {
  const viewshed::Observer& observer = request.observers.front();
  profile::Profile ground;
  if (surface.bare) ground = profile::from_section(surface.bare->between(observer.position, position));
  profile::Profile profile = profile::from_section(surface.lines.between(observer.position, position));
  profile::LosQuery query;
  query.from_on_surface = request.observers_on_surface, query.to_on_surface = request.targets_on_surface;
  query.earth = request.earth;
  query.nodata = request.nodata;
  query.clearance_error_m =
      profile::clearance_error(store, request.detail, request.themes, observer.position, position);
  const profile::EndGrounds ends =
      has_ground_at_ends(profile) ? stands_on(profile, ground, query) : profile::EndGrounds{};
  query.from_height_m = observer.height - (observer.absolute ? ends.from_m : 0);
  query.to_height_m = target_height(request) - (request.target_absolute ? ends.to_m : 0);
  return analyse(std::move(profile), query, std::move(ground));
}

/// How much higher the target would have to be.
Document lack(const profile::LosReport& report) {
  if (report.verdict == profile::SightVerdict::kVisible) return 0;
  if (report.required.empty() || !report.required.front().heights.to_alone_m) return nullptr;
  return std::max(0.0, *report.required.front().heights.to_alone_m - report.query.to_height_m);
}

std::string cause_at(const Store& store, std::uint16_t theme, Point2 place) {
  if (theme == 0) return "terrain";
  const auto feature = features_at(store, theme, {place}).front();
  return store.metadata().themes[theme - std::size_t{1}].name + (feature ? ", " + title_of(*feature) : "");
}

/// What hides the target first, seen from the observer.
Document blocker(const Store& store, const profile::LosReport& report) {
  if (report.obstructions.empty()) return nullptr;
  const profile::Obstruction& first = report.obstructions.front();
  const Point2 place = position_at(report, first.peak_at_m);
  return {{"distance_m", first.peak_at_m},
          {"x", place.x},
          {"y", place.y},
          {"elevation_m", first.peak_m},
          {"what", cause_at(store, first.theme, place)},
          {"theme", first.theme}};
}

}  // namespace

LiveProbe::LiveProbe(ServedStore& served) : served_(served), body_(body_of(served.metadata().crs_wkt)) {}

Document LiveProbe::answer(const Document& options, Point2 position) {
  ViewOptions view;
  take_view(options, view);
  std::vector<std::string> ignored;
  NoProgress quiet;
  const viewshed::Request& request = view.complete(served_.store(), ignored, quiet);
  const auto surface = served_.surface(request.detail, request.themes);
  const profile::LosReport report = line_to(served_.store(), *surface, request, position);
  Document answer{{"verdict", name_of(report.verdict)}, {"distance_m", report.profile.length_m}};
  add_azimuths(request.observers.front().position, position, answer);
  answer["ground_m"] = report.to.ground_m;
  answer["surface_m"] = ends_of(report.profile).to_m;
  answer["lacks_m"] = lack(report);
  answer["clearance_m"] = number_or_null(report.least_clearance_m);
  answer["blocker"] = blocker(served_.store(), report);
  return answer;
}

void LiveProbe::add_azimuths(Point2 from, Point2 to, Document& answer) {
  if (!to_geographic_) to_geographic_.emplace(served_.metadata().crs_wkt, body_.geographic_crs);
  const Geodesic between = geodesic((*to_geographic_)(from), (*to_geographic_)(to), body_.ellipsoid);
  answer["azimuth_deg"] = grid_azimuth_deg(from, to);
  answer["azimuth_true_deg"] = between.azimuth_deg;
  answer["back_azimuth_deg"] = grid_azimuth_deg(to, from);
  answer["back_azimuth_true_deg"] = between.back_azimuth_deg;
}

}  // namespace itin::cli
