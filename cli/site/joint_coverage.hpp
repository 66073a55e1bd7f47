// What the chosen and the existing sites serve together, and what ground without data leaves open of that.
//
// Under `--nodata unknown` a site certainly serves what it serves under block, and at most what it serves under clear.
// Places that enough sites serve under clear, but not under block, are undecided.
#pragma once

#include <cstddef>
#include <vector>

#include <itin/store.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/siting.hpp>

#include "site/site_inputs.hpp"

namespace itin::cli {

/// Returns indices in the inputs' positions: the chosen sites in their order, then the existing ones.
std::vector<std::size_t> serving_sites(const SiteInputs& inputs, const viewshed::Choice& choice);

/// Returns exactly what each existing site certainly serves. Throws as SiteCoverage::refine() does.
std::vector<viewshed::DemandSet> served_by_existing(const Store& store, const SiteOptions& options,
                                                    const SiteInputs& inputs, Progress& progress);

/// The elements of the targets that are served.
struct JointCoverage {
  viewshed::SiteTargets targets;
  std::vector<viewshed::DemandSet> certain;  ///< what each of the serving sites certainly serves
  viewshed::DemandSet undecided;             ///< what is served only if ground without data hides nothing
};

/// Returns the coverage of the demand. For masts `certain` is the certain part of `coverage`. Throws as
/// SiteCoverage::refine() does.
JointCoverage joint_coverage(const Store& store, const SiteOptions& options, const SiteInputs& inputs,
                             const viewshed::SiteCoverage& coverage, const viewshed::Choice& choice,
                             Progress& progress);

/// Returns the coverage of the cells within reach of the serving sites, for demand that is points.
JointCoverage joint_coverage_on_cells(const Store& store, const SiteOptions& options, const SiteInputs& inputs,
                                      const viewshed::SiteCoverage& coverage, const viewshed::Choice& choice,
                                      Progress& progress);

/// Returns what part of the demand is served, undecided, and neither: as parts of all demand.
viewshed::ClassShares demand_shares(const SiteOptions& options, const SiteInputs& inputs,
                                    const JointCoverage& coverage);

}  // namespace itin::cli
