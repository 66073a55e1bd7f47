// The result of a siting run, for tables, maps and the report.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <viewshed/site_coverage.hpp>
#include <viewshed/siting.hpp>

#include "site/joint_coverage.hpp"
#include "site/site_inputs.hpp"
#include "site/site_links.hpp"
#include "site/site_routes.hpp"

namespace itin::cli {

/// Returns a link's outcome: "clear" as served is meant, "hidden", "undecided", or in sight only.
const char* outcome_of(const SiteOptions& options, const SiteLink& link);

/// An option's coverage in the demand's own measure.
struct CoverageSummary {
  double certain = 0, possible = 0;
};

/// Rasters of the chosen sites, numbered first, and the existing ones behind them.
struct SiteRasters {
  RasterGrid grid;
  std::vector<std::uint16_t> redundancy;   ///< how many serve a cell; kOutside beyond reach or data
  std::vector<std::uint16_t> best_server;  ///< 1: the first chosen; 0: none
  std::vector<viewshed::Verdict> served;   ///< kVisible: by enough sites
  static constexpr std::uint16_t kOutside = 65535;

  std::uint64_t count(viewshed::Verdict verdict) const {
    return static_cast<std::uint64_t>(std::count(served.begin(), served.end(), verdict));
  }
};

struct SiteResult {
  const SiteOptions& options;
  const SiteInputs& inputs;
  const viewshed::SiteCoverage& coverage;
  const viewshed::Demand& measure;  ///< measures value and gains: the demand, or the heights seen of turbines
  viewshed::Choice choice;
  SiteNetwork network;
  std::vector<SiteRoute> routes;  ///< from the network's sites to the hub; empty without a hub
  /// By how much the value of masts would grow if ground without data hid nothing; the part of the value of turbines
  /// that is seen only then.
  double undecided = 0;
  viewshed::ClassShares shares;  ///< what the chosen and the existing sites serve of the demand, or leave undecided
  SiteRasters rasters;
  std::vector<double> ground_m;  ///< elevation of the ground under each chosen site, which may stand on a roof

  const viewshed::SitePosition& place_of(const viewshed::ChosenSite& site) const {
    return inputs.positions[site.option];
  }
  const Candidate& candidate(std::size_t option) const { return inputs.candidates[inputs.options[option].place]; }
  CoverageSummary summary(const viewshed::CoverageBounds& bounds) const {
    return {inputs.demand.in_metric(inputs.demand.weight(bounds.certain)),
            inputs.demand.in_metric(inputs.demand.weight(bounds.possible))};
  }
  double in_metric(viewshed::Weight weight) const { return measure.in_metric(weight); }
  /// Return what the chosen and the existing sites serve together: in the demand's own measure, and as a share of all
  /// demand.
  double served() const;
  double served_percent() const;
  double undecided_percent() const;
  /// Returns in words when a target is served, or what is to be least.
  std::string meaning() const;
  std::size_t refined() const;
  /// Tells whether every option was surveyed exactly from the first, and none by bounds.
  bool all_exact() const { return options.placement.sums_heights() || coverage.last_stage() == 0; }
  /// Tells whether no choice within the goal is better.
  bool is_best() const { return choice.lower_bound == choice.upper_bound; }
  /// Returns in words why an option is not part of the choice.
  std::string reason(std::size_t option) const;
  bool is_chosen(std::size_t option) const;

 private:
  /// Tells which chosen one an option is too near to stand beside.
  std::string too_near(std::size_t option) const;
};

/// Returns the survey for which sight lines are computed.
viewshed::SiteSurvey site_survey(const SiteOptions& options, const SiteInputs& inputs);

/// Returns the elevations of the bare ground under the chosen sites.
std::vector<double> site_grounds(const Store& store, const SiteInputs& inputs, const viewshed::Choice& choice,
                                 Progress& progress);

/// Returns rasters of the cells that the chosen and the existing sites serve. Outside is what has no ground or is
/// beyond reach: of all candidates and existing sites, or, where demand is points, of the chosen and existing ones.
SiteRasters site_rasters(const Store& store, const SiteOptions& options, const SiteInputs& inputs,
                         const viewshed::Choice& choice, const JointCoverage& cells, Progress& progress);

}  // namespace itin::cli
