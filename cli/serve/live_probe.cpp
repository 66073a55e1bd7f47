#include "serve/live_probe.hpp"

#include <algorithm>
#include <optional>

#include <profile/los.hpp>

#include "serve/live_view.hpp"

namespace itin::cli {

namespace {

double target_height(const viewshed::Request& request) {
  return request.observers.front().target_height.value_or(request.target_height);
}

/// The line from the first observer to a target at the position, judged as the view judges it.
profile::LosReport line_to(const ServedStore& served, const viewshed::Request& request, Point2 position) {
  const viewshed::Observer& observer = request.observers.front();
  const profile::StoreLine line{observer.position, position,          request.detail,
                                request.themes,    observer.absolute, request.target_absolute};
  profile::LosQuery query;
  query.from_height_m = observer.height, query.to_height_m = target_height(request);
  query.from_on_surface = request.observers_on_surface, query.to_on_surface = request.targets_on_surface;
  query.earth = request.earth;
  query.nodata = request.nodata;
  return analyse(served.store(), line, query);
}

/// How much higher the target would have to be.
Document lack(const profile::LosReport& report) {
  if (report.verdict == profile::SightVerdict::kVisible) return 0;
  if (report.required.empty() || !report.required.front().heights.to_alone_m) return nullptr;
  return std::max(0.0, *report.required.front().heights.to_alone_m - report.query.to_height_m);
}

/// What hides the target first, seen from the observer.
Document blocker(const profile::LosReport& report) {
  if (report.obstructions.empty()) return nullptr;
  const profile::Obstruction& first = report.obstructions.front();
  const Point2 place = position_at(report, first.peak_at_m);
  return {{"distance_m", first.peak_at_m},
          {"x", place.x},
          {"y", place.y},
          {"elevation_m", first.peak_m},
          {"what", cause_of(report, first.theme, first.feature)},
          {"theme", first.theme}};
}

template <class Value>
Document known(const std::optional<Value>& value) {
  return value ? Document(*value) : Document(nullptr);
}

}  // namespace

Document probe_answer(const ServedStore& served, const Document& options, Point2 position) {
  ViewOptions view;
  take_view(options, view);
  std::vector<std::string> ignored;
  const viewshed::Request& request = view.complete(served.metadata(), ignored);
  request.themes.check(served.metadata().themes);
  const profile::LosReport report = line_to(served, request, position);
  Document answer{{"verdict", name_of(report.verdict)}, {"distance_m", report.profile.length_m}};
  const auto add_azimuths = [&](const std::string& prefix, const profile::LosEnd& end) {
    answer[prefix + "azimuth_deg"] = end.site ? Document(end.site->azimuth_grid_deg) : Document(nullptr);
    answer[prefix + "azimuth_true_deg"] = end.site ? Document(end.site->azimuth_true_deg) : Document(nullptr);
  };
  add_azimuths("", report.from);
  add_azimuths("back_", report.to);
  answer["ground_m"] = report.to.ground_m;
  answer["surface_m"] = known(report.to.surface_m);
  answer["lacks_m"] = lack(report);
  answer["clearance_m"] = known(report.least_clearance_m);
  answer["blocker"] = blocker(report);
  return answer;
}

}  // namespace itin::cli
