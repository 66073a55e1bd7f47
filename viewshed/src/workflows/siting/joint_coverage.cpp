#include "workflows/siting/joint_coverage.hpp"

#include <algorithm>

#include <viewshed/site_links.hpp>

#include "workflows/siting/request_rules.hpp"

namespace itin::viewshed {

namespace {

SiteSurvey survey_of_serving(const SitePlanRequest& request, const SiteInputs& inputs,
                             const std::vector<std::size_t>& sites) {
  SiteSurvey survey = survey_of_all(request, inputs);
  survey.positions.clear();
  for (const std::size_t site : sites) survey.positions.push_back(inputs.positions[site]);
  survey.tolerance = 0;
  survey.open = OpenTargets::kUnserved;
  return survey;
}

/// Returns exactly what each site of the survey serves.
std::vector<DemandSet> served_exactly(const Store& store, const SiteSurvey& survey, Progress& progress) {
  SiteCoverage coverage(store, survey, progress);
  std::vector<DemandSet> served;
  for (std::size_t i = 0; i < survey.positions.size(); ++i) {
    while (!coverage.bounds(i).exact) coverage.refine({&i, 1});
    served.push_back(coverage.bounds(i).certain);
  }
  return served;
}

/// Returns the elements that the sites of the survey serve only if ground without data hides nothing. `certain` is what
/// each site serves if that ground hides everything behind it.
DemandSet open_to_missing_ground(const Store& store, SiteSurvey survey, const std::vector<DemandSet>& certain,
                                 int cover, Progress& progress) {
  survey.nodata = NoData::kClear;
  const std::vector<DemandSet> possible = served_exactly(store, survey, progress);
  const Demand elements(element_count(survey.targets));
  return difference(served_elements(elements, possible, cover), served_elements(elements, certain, cover));
}

}  // namespace

SiteSurvey survey_of_all(const SitePlanRequest& request, const SiteInputs& inputs) {
  SiteSurvey survey;
  survey.positions = inputs.positions;
  survey.targets = inputs.targets;
  survey.radius = request.radius;
  survey.earth = request.earth;
  survey.nodata = request.nodata;
  survey.open = open_targets(request);
  survey.themes = request.themes;
  if (request.by_level()) {
    survey.level =
        ServingLevel{*link_rules(request).query.radio, request.link_budget, request.least_dbm(), request.on_surface};
  } else if (request.frequency_ghz) {
    survey.fresnel = FresnelCriterion{wavelength_m(*request.frequency_ghz), request.fresnel};
  }
  survey.tolerance = request.tolerance;
  survey.engine = request.engine;
  survey.memory_bytes = request.memory_bytes;
  return survey;
}

std::vector<std::size_t> serving_sites(const SiteInputs& inputs, const Choice& choice) {
  std::vector<std::size_t> sites;
  for (const ChosenSite& site : choice.chosen) sites.push_back(site.option);
  for (std::size_t i = inputs.options.size(); i < inputs.positions.size(); ++i) sites.push_back(i);
  return sites;
}

std::vector<DemandSet> served_by_existing(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                                          Progress& progress) {
  if (inputs.existing() == 0) return {};
  return served_exactly(store, survey_of_serving(request, inputs, serving_sites(inputs, {})), progress);
}

JointCoverage joint_coverage(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                             const SiteCoverage& coverage, const Choice& choice, Progress& progress) {
  const std::vector<std::size_t> sites = serving_sites(inputs, choice);
  JointCoverage joint{inputs.targets, {}, {}};
  for (const std::size_t site : sites) joint.certain.push_back(coverage.bounds(site).certain);
  if (sites.empty() || !coverage.leaves_open()) return joint;
  const SiteSurvey survey = survey_of_serving(request, inputs, sites);
  const bool worst_case = open_targets(request) == OpenTargets::kServed;
  const bool known = !worst_case && std::all_of(sites.begin(), sites.end(),
                                                [&](std::size_t site) { return coverage.bounds(site).exact; });
  const std::vector<DemandSet> certain = known ? joint.certain : served_exactly(store, survey, progress);
  joint.undecided = open_to_missing_ground(store, survey, certain, request.cover, progress);
  if (worst_case) joint.certain = certain;
  // Existing sites may serve what no candidate reaches.
  if (!inputs.cells.empty()) joint.undecided = intersection(joint.undecided, inputs.cells);
  return joint;
}

JointCoverage joint_coverage_on_cells(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                                      const SiteCoverage& coverage, const Choice& choice, Progress& progress) {
  const std::vector<std::size_t> sites = serving_sites(inputs, choice);
  SiteSurvey survey = survey_of_serving(request, inputs, sites);
  survey.targets.points.clear(), survey.targets.heights.clear(), survey.targets.elements.clear();
  survey.targets.grid =
      grid_of_reach(store, sites.empty() ? inputs.positions : survey.positions, request.radius, request.cell_size);
  JointCoverage joint{survey.targets, {}, {}};
  if (sites.empty()) return joint;
  joint.certain = served_exactly(store, survey, progress);
  if (coverage.leaves_open())
    joint.undecided = open_to_missing_ground(store, survey, joint.certain, request.cover, progress);
  return joint;
}

ClassShares demand_shares(const SitePlanRequest& request, const SiteInputs& inputs, const JointCoverage& coverage) {
  const Demand& demand = inputs.demand;
  DemandSet served = served_elements(demand, coverage.certain, request.cover);
  // Existing sites may serve what no candidate reaches.
  if (!inputs.cells.empty()) served = intersection(served, inputs.cells);
  const auto percent = [&](Weight weight) { return 100 * demand.in_metric(weight) / demand.in_metric(inputs.total); };
  const Weight seen = demand.weight(served), undecided = demand.weight(coverage.undecided);
  return {"the demand", percent(seen), percent(inputs.total - seen - undecided), percent(undecided)};
}

}  // namespace itin::viewshed
