// The workflow of a choice of sites, from request to result.

#include <algorithm>
#include <numeric>
#include <utility>

#include <itin/error.hpp>
#include <viewshed/site_plan.hpp>

#include "workflows/siting/plan_checks.hpp"
#include "workflows/siting/point_results.hpp"
#include "workflows/siting/request_rules.hpp"
#include "workflows/siting/site_inputs.hpp"
#include "workflows/siting/site_network.hpp"
#include "workflows/siting/site_planner.hpp"
#include "workflows/siting/site_premises.hpp"
#include "workflows/siting/site_rasters.hpp"
#include "workflows/siting/visible_heights.hpp"

namespace itin::viewshed {

namespace {

void refine_fully(SiteCoverage& coverage, std::size_t option) {
  while (!coverage.bounds(option).exact) coverage.refine({&option, 1});
}

}  // namespace

SitePlanner::SitePlanner(const Store& store, SitePlanRequest request, Progress& progress)
    : store_(store), progress_(progress) {
  check(request);
  plan_.request = std::move(request);
  plan_.crs_wkt = store.metadata().crs_wkt;
  plan_.inputs = understood(store_, plan_.request, plan_.warnings, progress_);
  free_demand();
  require_memory(store_, plan_.request, plan_.inputs);
  hub_ = hub();
  goal_ = goal();
  require_enough(plan_.request, plan_.inputs);
  check_goal(plan_.inputs.options, goal_);
}

SitePlan SitePlanner::plan(SiteCoverage& coverage) && {
  if (plan_.request.on_survey) plan_.request.on_survey(coverage, plan_.inputs.positions.size());
  plan_.choice = plan_.heights ? choose_by_heights(coverage) : choose_by_coverage(coverage);
  coverage.release_surfaces();
  plan_.network = site_network(store_, plan_.request, plan_.inputs, plan_.choice, hub_, progress_);
  plan_.routes = site_routes(plan_.request, plan_.network);
  plan_.ground_m = grounds();
  tell_coverage(coverage);
  plan_.request.on_survey = {};  // it may refer to what the caller no longer has
  add_warnings(store_, plan_);
  return std::move(plan_);
}

/// Frees the memory of what the inputs hold by now.
void SitePlanner::free_demand() {
  SiteDemand& demand = plan_.request.demand;
  demand.weights = std::vector<double>();
  if (demand.points) demand.points->places = std::vector<SitePlace>();
}

std::optional<SitePosition> SitePlanner::hub() const {
  if (!plan_.request.hub) return std::nullopt;
  const SitePlace& place = *plan_.request.hub;
  const auto ground = ground_under(store_, {place.position},
                                   plan_.request.on_surface ? plan_.request.themes : ThemeChoice::none(), progress_);
  if (!ground.front()) throw InputError("`hub`: there is no data there; move it onto the data", "hub");
  return SitePosition{"hub", place.position, place.height.value_or(SitePlanRequest::kHubHeight), *ground.front()};
}

/// Returns the goal, except for what existing sites serve. It refers to the plan.
ChoiceGoal SitePlanner::goal() const {
  const SitePlanRequest& request = plan_.request;
  ChoiceGoal goal;
  goal.count = request.count;
  goal.budget = request.budget;
  if (request.share) goal.wanted = 0;
  goal.cover = request.cover;
  goal.exact_chosen = request.exact_chosen;
  goal.swaps = request.swaps;
  goal.objective = request.objective();
  if (has_spacing(request))
    goal.compatible = [this](std::size_t a, std::size_t b) {
      return may_both_stand(plan_.request, plan_.inputs.positions[a].position, plan_.inputs.positions[b].position);
    };
  if (request.has_links()) goal.network = link_network(store_, request, plan_.inputs, hub_, progress_);
  return goal;
}

std::vector<double> SitePlanner::possible_heights(std::vector<std::size_t> options) const {
  const NoData rule = plan_.request.nodata == NoData::kBlock ? NoData::kBlock : NoData::kClear;
  return summed_visible_heights(store_, {plan_.request, plan_.inputs, std::move(options), rule}, progress_);
}

void SitePlanner::take_heights(std::vector<double> heights_m) {
  heights_m_ = std::move(heights_m);
  plan_.heights.emplace(heights_m_);
}

/// Chooses by the heights shown; coverage is for the maps alone.
Choice SitePlanner::choose_by_heights(SiteCoverage& coverage) const {
  const SiteInputs& inputs = plan_.inputs;
  OwnElements own(inputs.options.size());
  Choice choice = choose(*plan_.heights, inputs.options, own, goal_, progress_);
  for (const ChosenSite& chosen : choice.chosen) refine_fully(coverage, chosen.option);
  for (std::size_t i = inputs.options.size(); i < inputs.positions.size(); ++i) refine_fully(coverage, i);
  return choice;
}

/// Chooses by coverage of the demand that existing sites do not certainly serve.
Choice SitePlanner::choose_by_coverage(SiteCoverage& coverage) {
  coverage.explore();
  goal_.existing = existing_coverage(coverage);
  if (plan_.request.share) goal_.wanted = wanted();
  return choose(plan_.inputs.demand, plan_.inputs.options, coverage, goal_, progress_);
}

/// Returns what each existing site certainly serves of the demand.
std::vector<DemandSet> SitePlanner::existing_coverage(SiteCoverage& coverage) const {
  const SiteInputs& inputs = plan_.inputs;
  std::vector<DemandSet> served;
  if (coverage.leaves_open() && open_targets(plan_.request) == OpenTargets::kServed) {
    coverage.release_surfaces();  // the memory holds those of one survey
    served = served_by_existing(store_, plan_.request, inputs, progress_);
  } else {
    for (std::size_t i = inputs.options.size(); i < inputs.positions.size(); ++i) {
      refine_fully(coverage, i);
      served.push_back(coverage.bounds(i).certain);
    }
  }
  if (!inputs.cells.empty())
    for (DemandSet& set : served) set = intersection(set, inputs.cells);
  return served;
}

/// Returns the value wanted. The share is of all demand, and the demand that existing sites serve counts towards it.
Weight SitePlanner::wanted() const {
  const SiteInputs& inputs = plan_.inputs;
  const Weight all = inputs.demand.at_least(*plan_.request.share * inputs.demand.in_metric(inputs.total));
  return std::max<Weight>(0, all - served_by(inputs.demand, goal_.existing, goal_.cover));
}

/// Returns the elevations of the bare ground under the chosen sites.
std::vector<double> SitePlanner::grounds() const {
  std::vector<Point2> positions;
  for (const ChosenSite& site : plan_.choice.chosen) positions.push_back(plan_.place_of(site).position);
  std::vector<double> grounds;
  for (const auto& ground : ground_under(store_, positions, ThemeChoice::none(), progress_))
    grounds.push_back(ground.value());
  return grounds;
}

/// Adds to the plan what the sites serve, and what is known of each option.
void SitePlanner::tell_coverage(const SiteCoverage& coverage) {
  const SitePlanRequest& request = plan_.request;
  const SiteInputs& inputs = plan_.inputs;
  plan_.leaves_open = coverage.leaves_open();
  const JointCoverage joint = joint_coverage(store_, request, inputs, coverage, plan_.choice, progress_);
  plan_.undecided = plan_.heights ? undecided_heights() : undecided_demand(coverage, joint);
  plan_.shares = demand_shares(request, inputs, joint);
  if (request.demand.premises) tell_premises(joint);
  if (tells_points(request)) plan_.points = point_results(store_, request, inputs, plan_.choice, joint, progress_);
  tell_rasters(inputs.targets.grid
                   ? joint
                   : joint_coverage_on_cells(store_, request, inputs, coverage, plan_.choice, progress_));
  for (std::size_t i = 0; i < inputs.options.size(); ++i)
    plan_.surveys.push_back({summary(coverage.first_bounds(i)), summary(coverage.bounds(i)), coverage.bounds(i).exact,
                             coverage.stage(i), coverage.stage_name(coverage.stage(i))});
  for (int stage = 0; stage <= coverage.last_stage(); ++stage) {
    const auto last = [&](const OptionSurvey& survey) { return survey.stage == stage; };
    plan_.stages.push_back({coverage.stage_name(stage),
                            static_cast<std::size_t>(std::count_if(plan_.surveys.begin(), plan_.surveys.end(), last))});
  }
  plan_.statistics = coverage.statistics();
}

void SitePlanner::tell_rasters(const JointCoverage& cells) {
  const SitePlanRequest& request = plan_.request;
  if (request.by_level())
    plan_.levels =
        std::make_shared<const Result>(site_levels(store_, request, plan_.inputs, plan_.choice, cells, progress_));
  plan_.rasters = site_rasters(store_, request, plan_.inputs, plan_.choice, cells, plan_.levels.get(), progress_);
}

void SitePlanner::tell_premises(const JointCoverage& joint) {
  plan_.premises = survey_of_choice(store_, plan_.request, plan_.inputs, plan_.choice, joint, progress_);
  for (const std::string& warning : plan_.premises->warnings)
    if (std::find(plan_.warnings.begin(), plan_.warnings.end(), warning) == plan_.warnings.end())
      plan_.warnings.push_back(warning);
}

CoverageSummary SitePlanner::summary(const CoverageBounds& bounds) const {
  const Demand& demand = plan_.inputs.demand;
  return {demand.in_metric(demand.weight(bounds.certain)), demand.in_metric(demand.weight(bounds.possible))};
}

/// Returns how much less the chosen turbines show if ground without data hides all behind it, metres.
double SitePlanner::undecided_heights() const {
  if (!plan_.leaves_open) return 0;
  std::vector<std::size_t> chosen;
  for (const ChosenSite& turbine : plan_.choice.chosen) chosen.push_back(turbine.option);
  const std::vector<double> certain =
      summed_visible_heights(store_, {plan_.request, plan_.inputs, chosen, NoData::kBlock}, progress_);
  double sum = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i) sum += heights_m_[chosen[i]] - certain[i];
  return sum;
}

/// Returns the demand that ground without data leaves open: of turbines only what may see a chosen one.
double SitePlanner::undecided_demand(const SiteCoverage& coverage, const JointCoverage& joint) const {
  DemandSet open = joint.undecided;
  if (plan_.request.turbines) {
    DemandSet possible;
    for (const ChosenSite& turbine : plan_.choice.chosen)
      possible = set_union(possible, coverage.bounds(turbine.option).possible);
    open = intersection(open, possible);
  }
  return plan_.inputs.demand.in_metric(plan_.inputs.demand.weight(open));
}

SitePlan plan_sites(const Store& store, SitePlanRequest request, Progress& progress) {
  SitePlanner planner(store, std::move(request), progress);
  if (planner.request().sums_heights()) {
    std::vector<std::size_t> all(planner.inputs().options.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    planner.take_heights(planner.possible_heights(std::move(all)));
  }
  SiteCoverage coverage(store, planner.survey(), progress);
  return std::move(planner).plan(coverage);
}

}  // namespace itin::viewshed
