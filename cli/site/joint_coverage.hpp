// What the chosen and the existing sites serve together, and what ground without data leaves open of that.
//
// Under `--nodata unknown` a site certainly serves what it serves under block, and at most what it serves under clear.
// Places that enough sites serve under clear, but not under block, are undecided.
#pragma once

#include <cstddef>
#include <vector>

#include <itin/store.hpp>
#include <viewshed/site_coverage.hpp>
#include <viewshed/siting.hpp>

#include "site/site_inputs.hpp"

namespace itin::cli {

/// Positions of the inputs: those of the chosen sites in their order, and of the existing ones behind them.
std::vector<std::size_t> serving_sites(const SiteInputs& inputs, const viewshed::Choice& choice);

/// Elements of the targets.
struct JointCoverage {
  viewshed::SiteTargets targets;
  std::vector<viewshed::DemandSet> certain;  ///< what each of the serving sites serves
  viewshed::DemandSet undecided;             ///< what is served only if ground without data hides nothing
};

/// Over the demand; from exact coverage, or what is certain of it. Throws as SiteCoverage::refine() does.
JointCoverage joint_coverage(const Store& store, const SiteOptions& options, const SiteInputs& inputs,
                             const viewshed::SiteCoverage& coverage, const viewshed::Choice& choice,
                             Progress& progress);

/// Over the cells within reach of the serving sites, for demand that is points.
JointCoverage joint_coverage_on_cells(const Store& store, const SiteOptions& options, const SiteInputs& inputs,
                                      const viewshed::SiteCoverage& coverage, const viewshed::Choice& choice,
                                      Progress& progress);

}  // namespace itin::cli
