#include <algorithm>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <viewshed/hidden_eyes.hpp>

#include "workflows/siting/plan_checks.hpp"

namespace itin::viewshed {

namespace {

constexpr std::size_t kMostWarnings = 20;

void warn_of_left_out(const SitePlan& plan, std::vector<std::string>& warnings) {
  std::vector<std::string> lines = plan.inputs.left_out;
  // The caller does not know proposed candidates: it is enough to say how many were left out.
  for (std::size_t i = plan.request.search_area ? plan.inputs.barred.size() : 0; i-- > 0;) {
    const BarredCandidates& barred = plan.inputs.barred[i];
    const auto first = lines.begin() + static_cast<std::ptrdiff_t>(barred.first);
    *first = fmt::format("{}, each of which {}; all are listed in `left_out`",
                         counted(barred.count, "proposed candidate"), barred.why);
    lines.erase(first + 1, first + static_cast<std::ptrdiff_t>(barred.count));
  }
  for (std::size_t i = 0; i < std::min(lines.size(), kMostWarnings); ++i) warnings.push_back("left out: " + lines[i]);
  if (lines.size() > kMostWarnings)
    warnings.push_back(fmt::format("left out: {} more; all are listed in `left_out`", lines.size() - kMostWarnings));
}

/// Warns where the radius reaches beyond the data, since demand there is not counted.
void warn_of_reach(const SitePlan& plan, const StoreMetadata& metadata, std::vector<std::string>& warnings) {
  const Box data = metadata.grid.box(metadata.bounds);
  const std::vector<SitePosition>& places = plan.inputs.positions;
  const auto beyond = std::count_if(places.begin(), places.end(), [&](const SitePosition& place) {
    const Point2 p = place.position;
    return std::min({p.x - data.xmin, data.xmax - p.x, p.y - data.ymin, data.ymax - p.y}) < plan.request.radius;
  });
  if (beyond == 0) return;
  warnings.push_back(
      fmt::format("the radius of {:g} m reaches beyond the data from {} of {}: demand there is not counted, so that "
                  "places near the edge of the data seem less seen than they are; import a larger source, or give a "
                  "smaller `radius`",
                  plan.request.radius, grouped(static_cast<std::uint64_t>(beyond)), counted(places.size(), "place")));
}

void warn_of_too_few(const SitePlan& plan, std::vector<std::string>& warnings) {
  const SitePlanRequest& request = plan.request;
  const bool short_of_share = request.share && plan.inputs.demand.in_metric(plan.choice.value + plan.choice.existing) <
                                                   *request.share * plan.inputs.demand.in_metric(plan.inputs.total);
  const bool share_reached = request.share && !short_of_share;
  if (request.count && plan.choice.chosen.size() < *request.count && !share_reached)
    warnings.push_back(fmt::format("{} chosen, not {}: no other site that may be chosen serves anything more",
                                   counted(plan.choice.chosen.size(), "site"), *request.count));
  const std::size_t serving = plan.choice.chosen.size() + plan.inputs.existing();
  if (request.cover > 1 && serving < static_cast<std::size_t>(request.cover))
    warnings.push_back(fmt::format("nothing counts as served: `cover` asks for {} sites, and there {} {}",
                                   request.cover, serving == 1 ? "is" : "are", serving));
  if (request.budget && plan.choice.chosen.empty())
    warnings.emplace_back("nothing is chosen: no site that serves anything costs as little as `budget`");
  if (short_of_share)
    warnings.emplace_back(
        "the share asked for is not reached: no further site that may be chosen serves anything more");
}

void warn_of_hidden_sites(const Store& store, const SitePlan& plan, std::vector<std::string>& warnings) {
  if (plan.request.on_surface) return;
  Eyes eyes{"site", {}, Detail::tolerance(0), plan.request.themes};
  for (const SitePosition& p : plan.inputs.positions)
    eyes.places.push_back({p.position.x, p.position.y, p.elevation()});
  warn_of_hidden_eyes(store, eyes, warnings);
}

}  // namespace

void add_warnings(const Store& store, SitePlan& plan) {
  std::vector<std::string>& warnings = plan.warnings;
  warn_of_left_out(plan, warnings);
  if (plan.request.turbines && plan.request.demand.is_cells_in_reach()) warn_of_reach(plan, store.metadata(), warnings);
  warn_of_hidden_sites(store, plan, warnings);
  if (plan.inputs.demand_without_ground > 0)
    warnings.push_back(fmt::format("{} of the demand cannot be served: there is no ground data",
                                   counted(plan.inputs.demand_without_ground, "point")));
  warn_of_too_few(plan, warnings);
}

}  // namespace itin::viewshed
