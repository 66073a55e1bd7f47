// A choice of sites in two steps: the request as it was understood, which says what is to be surveyed; and the plan,
// which follows from the survey.
//
//   SitePlanner planner(store, request, progress);
//   SiteCoverage coverage(store, planner.survey(), progress);
//   const SitePlan plan = std::move(planner).plan(coverage);
#pragma once

#include <optional>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/site_plan.hpp>

#include "workflows/siting/joint_coverage.hpp"

namespace itin::viewshed {

class SitePlanner {
 public:
  /// Understands the request. Store and progress must outlive the planner. Throws as plan_sites() does.
  SitePlanner(const Store& store, SitePlanRequest request, Progress& progress);
  SitePlanner(const SitePlanner&) = delete;  // the goal of the choice refers to it
  SitePlanner& operator=(const SitePlanner&) = delete;

  const SitePlanRequest& request() const { return plan_.request; }
  const SiteInputs& inputs() const { return plan_.inputs; }
  SiteSurvey survey() const { return survey_of_all(plan_.request, plan_.inputs); }

  /// Returns how much of its turbine each of these options may show. Precondition: request().sums_heights().
  std::vector<double> possible_heights(std::vector<std::size_t> options) const;
  /// Takes that of all options, by which plan() then chooses.
  void take_heights(std::vector<double> heights_m);

  /// Makes the plan. The coverage is one of survey(). To be called once. Precondition: where request().sums_heights(),
  /// the heights have been taken.
  SitePlan plan(SiteCoverage& coverage) &&;

 private:
  void free_demand();
  std::optional<SitePosition> hub() const;
  ChoiceGoal goal() const;
  Choice choose_by_heights(SiteCoverage& coverage) const;
  Choice choose_by_coverage(SiteCoverage& coverage);
  std::vector<DemandSet> existing_coverage(SiteCoverage& coverage) const;
  Weight wanted() const;
  std::vector<double> grounds() const;
  void tell_coverage(const SiteCoverage& coverage);
  void tell_rasters(const JointCoverage& cells);
  void tell_premises(const JointCoverage& joint);
  CoverageSummary summary(const CoverageBounds& bounds) const;
  double undecided_heights() const;
  double undecided_demand(const SiteCoverage& coverage, const JointCoverage& joint) const;

  const Store& store_;
  Progress& progress_;
  SitePlan plan_;
  std::optional<SitePosition> hub_;
  ChoiceGoal goal_;
  std::vector<double> heights_m_;
};

}  // namespace itin::viewshed
