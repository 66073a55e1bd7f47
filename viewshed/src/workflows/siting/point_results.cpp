#include "workflows/siting/point_results.hpp"

#include <algorithm>
#include <limits>

#include <itin/memory_shares.hpp>

#include "progress/stage.hpp"
#include "workflows/siting/link_judge.hpp"

namespace itin::viewshed {

namespace {

LinkRules rules_of_points(const SitePlanRequest& request) {
  LinkRules rules = link_rules(request);
  rules.query.to_on_surface = request.demand.on_surface;
  rules.query.budget = request.link_budget;
  return rules;
}

/// How near a line comes to serving its end: by its verdict, then by how much of it is clear.
struct Nearness {
  int verdict = 0;
  double clear = -std::numeric_limits<double>::infinity();

  Nearness(const LinkRules& rules, const profile::LineFindings& found) {
    using enum profile::SightVerdict;
    verdict = rules.met_by(found) ? 3 : found.verdict == kUndecided ? 2 : found.verdict == kVisible ? 1 : 0;
    if (found.clearance_m) clear = *found.clearance_m;
    if (found.fresnel) clear = found.fresnel->fraction;
  }

  auto operator<=>(const Nearness&) const = default;

  PointService service() const {
    return verdict >= 2 ? PointService::kUndecided : verdict == 1 ? PointService::kZoneCut : PointService::kHidden;
  }
};

ServingLine told_line(std::size_t site, double distance_m, const profile::LineFindings& found) {
  ServingLine line{.site = site, .distance_m = distance_m};
  if (found.critical) line.tightest_m = found.critical->distance_m;
  line.tightest_clearance_m = found.clearance_m;
  if (found.fresnel) line.fresnel_fraction = found.fresnel->fraction;
  return line;
}

/// The line between a site and a point with what it gives the receiver.
struct MeasuredLine {
  ServingLine line;
  PointService unserved = PointService::kHidden;  ///< what the point is where nothing serves it
  /// Greater levels come nearer to serving, and no level at all is farthest from it.
  double level() const { return line.level_dbm.value_or(-std::numeric_limits<double>::infinity()); }
};

class PointJudge {
 public:
  PointJudge(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs, const Choice& choice,
             const JointCoverage& coverage)
      : request_(request),
        coverage_(coverage),
        lines_(store, rules_of_points(request), section_cache_within(request.memory_bytes)) {
    for (const std::size_t site : serving_sites(inputs, choice)) sites_.push_back(inputs.positions[site]);
  }

  /// Completes a result that has its place, on its ground.
  void judge(std::size_t element, PointResult& result) const {
    std::vector<std::size_t> serving;
    for (std::size_t i = 0; i < sites_.size(); ++i)
      if (coverage_.certain[i].contains(element)) serving.push_back(i);
    result.serving = serving.size();
    if (request_.by_level()) {
      find_strongest(serving, result);
    } else if (!serving.empty()) {
      const std::size_t nearest = *std::min_element(serving.begin(), serving.end(), [&](std::size_t a, std::size_t b) {
        return metres_to(a, result) < metres_to(b, result);
      });
      result.line = told_line(nearest, metres_to(nearest, result), lines_.found(sites_[nearest], result.place));
    } else {
      find_nearest_to_serving(result);
    }
    if (!serving.empty()) {
      const bool enough = serving.size() >= static_cast<std::size_t>(request_.cover);
      result.service = enough ? PointService::kServed : PointService::kTooFew;
    }
    if (coverage_.undecided.contains(element)) result.service = PointService::kUndecided;
  }

 private:
  double metres_to(std::size_t site, const PointResult& result) const {
    return distance(sites_[site].position, result.place.position);
  }

  void find_nearest_to_serving(PointResult& result) const {
    std::optional<Nearness> best;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      const double metres = metres_to(i, result);
      if (metres > request_.radius) continue;
      const profile::LineFindings found = lines_.found(sites_[i], result.place);
      const Nearness nearness(lines_.rules(), found);
      if (best && !(*best < nearness)) continue;
      best = nearness;
      result.line = told_line(i, metres, found);
    }
    if (best) result.service = best->service();
  }

  /// Takes the line of the greatest level: among those of the sites that serve, where any does.
  void find_strongest(const std::vector<std::size_t>& serving, PointResult& result) const {
    std::optional<MeasuredLine> best;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (metres_to(i, result) > request_.radius) continue;
      if (!serving.empty() && !std::binary_search(serving.begin(), serving.end(), i)) continue;
      MeasuredLine measured = measured_line(i, result);
      if (!best || best->level() < measured.level()) best = std::move(measured);
    }
    if (!best) return;
    result.line = best->line;
    result.service = best->unserved;
  }

  MeasuredLine measured_line(std::size_t site, const PointResult& result) const {
    const auto [found, budget, sector] = lines_.measured(sites_[site], result.place);
    MeasuredLine measured{told_line(site, metres_to(site, result), found)};
    if (!budget) return measured;
    measured.line.level_dbm = budget->level_dbm, measured.line.margin_db = budget->margin_db;
    measured.line.sector = sector;
    if (budget->rain) measured.line.rain_exceeded_db = budget->rain->exceeded_db;
    measured.line.availability = budget->availability;
    measured.unserved = PointService::kTooWeak;
    return measured;
  }

  const SitePlanRequest& request_;
  const JointCoverage& coverage_;
  LinkJudge lines_;
  std::vector<SitePosition> sites_;  ///< in the order of the coverage, and of the network's ends
};

}  // namespace

std::vector<PointResult> point_results(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                                       const Choice& choice, const JointCoverage& coverage, Progress& progress) {
  const SiteTargets& targets = inputs.targets;
  const auto grounds =
      ground_under(store, targets.points, targets.on_surface ? request.themes : ThemeChoice::none(), progress);
  const PointJudge judge(store, request, inputs, choice, coverage);
  std::vector<PointResult> results(targets.points.size());
  for_each_step(results.size(), "points of the demand", progress, [&](std::size_t i) {
    PointResult& result = results[i];
    result.point = inputs.points[i];
    result.place = {result.point.name, targets.points[i], targets.height_of(i), grounds[i].value_or(0)};
    grounds[i] ? judge.judge(i, result) : void(result.service = PointService::kNoGround);
  });
  std::sort(results.begin(), results.end(),
            [](const PointResult& a, const PointResult& b) { return a.point.number < b.point.number; });
  return results;
}

}  // namespace itin::viewshed
