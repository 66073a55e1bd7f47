// What the chosen and the existing sites serve together, and what ground without data leaves open of that.
//
// Under NoData::kUnknown a site certainly serves what it serves under kBlock, and at most what it serves under kClear.
// Places that enough sites serve under kClear, but not under kBlock, are undecided.
#pragma once

#include <cstddef>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

/// Returns the survey for which sight lines are computed.
SiteSurvey survey_of_all(const SitePlanRequest& request, const SiteInputs& inputs);

/// Returns indices in the inputs' positions: the chosen sites in their order, then the existing ones.
std::vector<std::size_t> serving_sites(const SiteInputs& inputs, const Choice& choice);

/// Returns exactly what each existing site certainly serves. Throws as SiteCoverage::refine() does.
std::vector<DemandSet> served_by_existing(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                                          Progress& progress);

/// The elements of the targets that are served.
struct JointCoverage {
  SiteTargets targets;
  std::vector<DemandSet> certain;  ///< what each of the serving sites certainly serves
  DemandSet undecided;             ///< what is served only if ground without data hides nothing
};

/// Returns the coverage of the demand. For masts `certain` is the certain part of `coverage`. Throws as
/// SiteCoverage::refine() does.
JointCoverage joint_coverage(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                             const SiteCoverage& coverage, const Choice& choice, Progress& progress);

/// Returns the coverage of the cells within reach of the serving sites, for demand that is points.
JointCoverage joint_coverage_on_cells(const Store& store, const SitePlanRequest& request, const SiteInputs& inputs,
                                      const SiteCoverage& coverage, const Choice& choice, Progress& progress);

/// Returns what part of the demand is served, undecided, and neither: as parts of all demand.
ClassShares demand_shares(const SitePlanRequest& request, const SiteInputs& inputs, const JointCoverage& coverage);

}  // namespace itin::viewshed
